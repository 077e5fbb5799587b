import { Button, FileButton, Loader, Modal } from "@mantine/core";
import { useQuery } from "@tanstack/react-query";
import { IconFileImport } from "@tabler/icons-react";

import { sentences } from "../../api/client";
import { maps3dQuery, runsQuery } from "../../api/queries";
import type { Map3d } from "../../api/types";
import { Reasons } from "../../ui/Reasons";
import css from "../plan.module.css";
import { ownMapName, ownMapNote } from "./ownMap";

interface Props {
  siteId: string;
  onTake: (source: Map3d | File) => void;
  onClose: () => void;
}

/** The maps that the station made of this farm's runs, and the way to a file. */
export function MapRowsDialog({ siteId, onTake, onClose }: Props) {
  return (
    <Modal opened onClose={onClose} title={<b>Rows from a 3D map</b>}>
      <div className={css.stack}>
        <OwnMaps siteId={siteId} onTake={onTake} />
        <FileButton accept=".laz,.las,.pcd,.ply" onChange={(file) => file && onTake(file)}>
          {(props) => (
            <Button {...props} size="lg" variant="default" fullWidth justify="flex-start" leftSection={<IconFileImport size={22} />}>
              From a file …
            </Button>
          )}
        </FileButton>
        <p className={css.quiet}>A file may be LAZ, LAS, PCD or PLY. What is found is proposed first: nothing is drawn before you accept it.</p>
      </div>
    </Modal>
  );
}

function OwnMaps({ siteId, onTake }: Omit<Props, "onClose">) {
  const maps = useQuery(maps3dQuery(siteId));
  const runs = useQuery(runsQuery).data ?? [];
  if (maps.error) return <Reasons reasons={sentences(maps.error)} />;
  if (!maps.data) return <Loader />;
  if (maps.data.length === 0) return <p className={css.quiet}>This farm has no 3D map of its own yet. Drive a mission with a 3D LiDAR, open it under Runs and press “Make the 3D map”.</p>;
  return (
    <ul className={css.list} aria-label="3D maps of this farm">
      {maps.data.map((map) => (
        <li key={map.run_id}>
          <button type="button" className={`${css.item} ${css.tall}`} disabled={!map.georeferenced} onClick={() => onTake(map)}>
            <b>{ownMapName(map, runs)}</b>
            <small>{ownMapNote(map)}</small>
          </button>
        </li>
      ))}
    </ul>
  );
}

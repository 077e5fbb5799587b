import { useEffect, useMemo, useRef } from "react";

import type { SiteMap } from "../../api/types";
import type { SiteFrame } from "../../geo/siteFrame";
import { useMap } from "../../map/MapView";
import { Z, useVectorLayer } from "../../map/layer";
import { type ItemRef, refOf, sameItem } from "../../map/siteFeatures";
import { siteStyle } from "../../map/siteStyle";
import { HintBar } from "./HintBar";
import { type EditorEvents, SiteEditor } from "./SiteEditor";
import type { Tool } from "./tools";

interface Props extends EditorEvents {
  site: SiteMap;
  frame: SiteFrame;
  tool: Tool;
  selected: ItemRef | null;
  onCancel: () => void;
}

/** The site as something to draw on. */
export function EditLayer({ site, frame, tool, selected, onCancel, ...events }: Props) {
  const map = useMap();
  const chosen = useRef(selected);
  chosen.current = selected;
  const style = useMemo(() => siteStyle((feature) => chosen.current !== null && sameItem(refOf(feature), chosen.current)), []);
  const source = useVectorLayer(Z.site, style, true);
  const newest = useRef(events);
  newest.current = events;
  const editor = useMemo(() => ({ current: null as SiteEditor | null }), []);
  useEffect(() => {
    const made = new SiteEditor(map, source, frame, {
      onSelect: (ref) => newest.current.onSelect(ref),
      onDrawn: (drawn, points) => newest.current.onDrawn(drawn, points),
      onReshaped: (ref, points) => newest.current.onReshaped(ref, points),
    });
    editor.current = made;
    return () => made.close();
  }, [map, source, frame, editor]);
  useEffect(() => editor.current?.setSite(site), [site, map, source, frame, editor]);
  useEffect(() => editor.current?.setSelected(selected), [selected, map, source, frame, editor]);
  useEffect(() => editor.current?.setTool(tool), [tool, map, source, frame, editor]);
  return <HintBar tool={tool} onDone={() => editor.current?.finish()} onBack={() => editor.current?.removeLastPoint()} onCancel={onCancel} />;
}

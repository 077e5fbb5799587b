import { ActionIcon, Menu } from "@mantine/core";
import { IconDotsVertical } from "@tabler/icons-react";
import type { ReactNode } from "react";

/** Three dots that open a menu with what is needed less often. `children` are its items. */
export function MoreButton({ label, size = 44, loading, children }: { label: string; size?: number; loading?: boolean; children: ReactNode }) {
  return (
    <Menu position="bottom-end" width={260}>
      <Menu.Target>
        <ActionIcon size={size} loading={loading} aria-label={label}>
          <IconDotsVertical />
        </ActionIcon>
      </Menu.Target>
      <Menu.Dropdown>{children}</Menu.Dropdown>
    </Menu>
  );
}

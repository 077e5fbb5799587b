"""PLY, the Stanford form of points and meshes: its vertices."""

from __future__ import annotations

from navcore.errors import CloudError
from navcore.maps.cloud_files.file_cloud import FileCloud, file_cloud
from navcore.maps.cloud_files.ply_header import PlyForm, PlyHeader, read_header
from navcore.maps.cloud_files.table import ascii_table, binary_table


def read_ply(data: bytes, source: str) -> FileCloud:
    """Vertices of a PLY file, ascii or binary of either byte order; faces are passed over.

    Raises CloudError that names `source` and the place.
    """
    header = read_header(data, source)
    names = header.vertex.names or ()
    if not names:
        raise CloudError(f"{source}: its vertices have no properties; export it with x, y and z.")
    body = data[header.start :]
    if header.form is PlyForm.ASCII:
        table = ascii_table(_after(body, header), len(names), header.vertices, source)
        return file_cloud({name: table[:, k] for k, name in enumerate(names)}, source)
    rows = binary_table(body[header.before_bytes :], header.vertex, header.vertices, source)
    return file_cloud({name: rows[name] for name in names}, source)


def _after(body: bytes, header: PlyHeader) -> bytes:
    """The lines from the first vertex on."""
    if not header.before_lines:
        return body
    return b"\n".join([line for line in body.splitlines() if line.strip()][header.before_lines :])

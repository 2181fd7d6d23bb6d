"""Reads a field of volume fractions, writes its surface, and says how well their volumes agree:

    surface.py FIELD.nrrd SURFACE.ply
"""

import sys

import numpy as np

import difmesh


def main(source: str, target: str) -> None:
    field = difmesh.read_field(source)
    # Any array of fractions does as well: difmesh.reconstruct(array, spacing=..., origin=...)
    mesh = difmesh.reconstruct(
        field, progress=lambda share: print(f"\r{share:4.0%}", end="", file=sys.stderr)
    )
    corners = mesh.points[mesh.faces]  # (triangles, 3 corners, 3 coordinates)
    volume = np.linalg.det(corners).sum() / 6
    print(f"{mesh}, volume {volume:.10g}, in the fractions {mesh.report.fraction_volume:.10g}")
    planes = difmesh.normals(field)  # those of the cells, without a mesh
    print(f"planes in {np.count_nonzero(planes.sources)} cells")
    mesh.save(target)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(f"usage: {sys.argv[0]} FIELD SURFACE")
    try:
        main(*sys.argv[1:])
    except (difmesh.Error, ValueError) as error:
        sys.exit(f"\n{error}")

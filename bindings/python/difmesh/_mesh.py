"""Triangle meshes."""

from __future__ import annotations

import warnings
from ctypes import byref, c_char_p, c_int64, c_void_p
from dataclasses import dataclass, fields
from typing import Any, Mapping, Optional, Sequence, Union

import numpy as np
import numpy.typing as npt

from ._calls import Handle
from ._errors import Warning, check, warn_of
from ._library import defaults, library
from ._memory import Path, address_of, from_address, path_bytes
from ._structs import DifMeasure, DifMeshReadOptions, DifMeshWriteReport, DifReport
from ._write_options import text_bytes, to_write_options


@dataclass(frozen=True)
class Report:
    """Facts about a reconstruction."""

    cells: int  #: read
    interfacial_cells: int  #: purity_tolerance < fraction < 1 - purity_tolerance
    clamped_cells: int  #: fraction < 0 or > 1
    largest_overshoot: float  #: largest distance of a fraction from [0, 1]
    fraction_volume: float  #: sum of fraction x cell volume, clamped
    planes: int  #: cells that were given a normal and a plane
    height_function_cells: int  #: of these, with a normal from heights
    gradient_free_cells: int  #: of these, without gradient: edge directions were used
    solved_edges: int  #: vertices placed by the half-full window
    newton_steps_mean: float  #: per solved edge
    newton_steps_max: int
    non_monotone_edges: int  #: solved edges along which the window's fraction falls
    enclosed_volume: float  #: signed; 0 where not closed
    closed: bool  #: no boundary edge; an empty mesh is closed
    seconds_classify: float  #: wall time: the pass over the field
    seconds_normals: float  #: normals and planes
    seconds_count: float  #: counting and allocation of the output
    seconds_vertices: float
    seconds_triangles: float
    seconds_total: float
    curved_cells: int  #: "curved": cells that own a curved surface
    curved_vertices: int  #: vertices that such surfaces placed
    moved_centres: int  #: cells whose centre they put on another side than fraction >= 1/2 does


@dataclass(frozen=True)
class Measure:
    """Facts about a mesh from its arrays alone; vertices are told apart by index."""

    vertices: int  #: in use or not
    edges: int
    triangles: int
    components: int  #: of triangles joined by edges
    isolated_vertices: int  #: in no triangle
    boundary_edges: int  #: with one triangle
    non_manifold_edges: int  #: with more than two
    misoriented_edges: int  #: with two that run along it the same way
    non_manifold_vertices: int  #: whose triangles are not one fan or one cycle
    degenerate_triangles: int  #: an index twice, or area exactly 0
    euler_number: int  #: V - E + F over the vertices in use
    closed: bool  #: every edge has an even number of triangles
    manifold: bool  #: no non-manifold edge or vertex, no misoriented edge
    area: float
    volume: float  #: signed; means something only where has_volume
    low: tuple[float, float, float]  #: bounding box of all positions
    high: tuple[float, float, float]
    unbalanced_edges: int  #: with more than two triangles, more one way than the other
    #: Triangles run along every edge as often one way as the other, where vertices at equal
    #: positions count as one.
    has_volume: bool


@dataclass(frozen=True)
class WriteReport:
    """What became of a mesh in a file. Counts are those of the file: STL has three vertices per
    triangle, the parts of a split glTF repeat some, and Draco adds some where the mesh is not
    manifold."""

    bytes: int  #: size of the file
    vertices: int
    triangles: int
    primitives: int  #: of glTF; 1 in other formats
    position_bits: int  #: of Draco; 0 without
    position_error: float  #: no coordinate is off by more; exact for STL, 0 for PLY, OBJ and OFF
    local_origin: tuple[float, float, float]  #: glTF, Draco: positions are relative to it; else 0
    #: STL: triangles that lose their area in float32; else 0
    collapsed_triangles: int


def to_dataclass(kind: type[Any], struct: Any) -> Any:
    """A dataclass from the struct's fields of the same names."""
    values = {}
    for field in fields(kind):
        value = getattr(struct, field.name)
        if field.type in ("bool", bool):
            value = value != 0
        elif hasattr(value, "__len__"):
            value = tuple(value)
        values[field.name] = value
    return kind(**values)


def triples(array: Any, name: str) -> npt.NDArray[np.float64]:
    """(n, 3) doubles without gaps; copied where they are not."""
    result = np.ascontiguousarray(array, dtype=np.float64)
    if result.ndim != 2 or result.shape[1] != 3:
        raise ValueError(f"{name} must have shape (n, 3), got {result.shape}")
    return np.require(result, requirements=["A", "C"])


def indices(array: Any) -> npt.NDArray[np.uint32]:
    given = np.asarray(array)
    if given.size == 0:
        given = given.reshape(-1, 3).astype(np.uint32)
    if given.dtype.kind not in "iu":
        raise TypeError(f"faces must be integers, got {given.dtype}")
    if given.ndim != 2 or given.shape[1] != 3:
        raise ValueError(f"faces must have shape (m, 3), got {given.shape}")
    if given.size and (given.min() < 0 or given.max() > np.iinfo(np.uint32).max):
        raise ValueError("faces hold an index that is negative or beyond 2^32 - 1")
    return np.require(given, np.uint32, ["A", "C"])


def new_mesh_handle() -> Handle:
    return Handle(library.dif_mesh_free)


class Mesh:
    """Triangles, counter-clockwise seen from the empty side. Cannot be changed.

    The arrays are read-only views of the library's memory, which lives as long as any of them or
    the mesh; `copy()` them to write. May be used from several threads at once. Pickling copies the
    arrays, but not the report.
    """

    __slots__ = ("_handle",)
    _handle: Handle

    def __init__(
        self,
        points: Any,
        faces: Any,
        normals: Any = None,
        edge_ids: Any = None,
        scalars: Optional[Mapping[str, Any]] = None,
    ) -> None:
        """Copies points (n, 3), faces (m, 3), and if given, normals (n, 3), edge_ids (n,) and
        scalars, names to arrays (n,)."""
        positions = triples(points, "points")
        corners = indices(faces)
        self._handle = new_mesh_handle()
        check(
            library.dif_mesh_from_arrays(
                address_of(positions),
                len(positions),
                address_of(corners),
                len(corners),
                byref(self._handle.pointer),
            )
        )
        if normals is not None:
            vectors = triples(normals, "normals")
            if len(vectors) != len(positions):
                raise ValueError(f"{len(positions)} points, but {len(vectors)} normals")
            check(library.dif_mesh_set_normals(self._handle.pointer, address_of(vectors)))
        if edge_ids is not None:
            ids = np.require(edge_ids, np.uint64, ["A", "C"])
            if ids.shape != (len(positions),):
                raise ValueError(f"{len(positions)} points, but edge_ids of shape {ids.shape}")
            check(library.dif_mesh_set_edge_ids(self._handle.pointer, address_of(ids)))
        for name, values in (scalars or {}).items():
            numbers = np.require(values, np.float64, ["A", "C"])
            if numbers.shape != (len(positions),):
                raise ValueError(
                    f"{len(positions)} points, but scalars {name!r} of shape {numbers.shape}"
                )
            # Not address_of(): NULL would remove, so that a bad name would go unnoticed.
            check(
                library.dif_mesh_set_scalars(
                    self._handle.pointer, text_bytes(name, "name"), numbers.ctypes.data
                )
            )

    @classmethod
    def _from_handle(cls, handle: Handle) -> Mesh:
        mesh = cls.__new__(cls)
        mesh._handle = handle
        return mesh

    def _borrow(self, getter: Any, columns: tuple[int, ...], dtype: str) -> npt.NDArray[Any]:
        pointer, count = c_void_p(), c_int64()
        check(getter(self._handle.pointer, byref(pointer), byref(count)))
        return from_address(pointer.value, (count.value, *columns), dtype, owner=self._handle)

    @property
    def points(self) -> npt.NDArray[np.float64]:
        """Coordinates of the vertices, (n, 3)."""
        return self._borrow(library.dif_mesh_positions, (3,), "f8")

    @property
    def faces(self) -> npt.NDArray[np.uint32]:
        """Indices of the triangles' vertices, (m, 3), from 0."""
        return self._borrow(library.dif_mesh_triangles, (3,), "u4")

    @property
    def normals(self) -> Optional[npt.NDArray[np.float64]]:
        """Unit vectors at the vertices, out of the material, (n, 3); None if the mesh has none: see
        `vertex_normals` of reconstruct()."""
        array = self._borrow(library.dif_mesh_normals, (3,), "f8")
        return array if len(array) else None

    @property
    def edge_ids(self) -> Optional[npt.NDArray[np.uint64]]:
        """Names of the edges of the grid of cell centres that the vertices lie on, ascending, (n,);
        None if the mesh has none: see `edge_ids` of reconstruct()."""
        array = self._borrow(library.dif_mesh_edge_ids, (), "u8")
        return array if len(array) else None

    @property
    def scalars(self) -> dict[str, npt.NDArray[np.float64]]:
        """Numbers that go with the points, (n,) by name: those that the mesh was made with, or that
        came with its file."""
        return {
            key.decode(errors="replace"): self._borrow(
                lambda mesh, *out, key=key: library.dif_mesh_scalars(mesh, key, *out), (), "f8"
            )
            for key in self._scalar_names()
        }

    def _scalar_names(self) -> list[bytes]:
        names: list[bytes] = []
        name = c_char_p()
        while True:
            check(library.dif_mesh_scalars_name(self._handle.pointer, len(names), byref(name)))
            if name.value is None:
                return names
            names.append(name.value)

    @property
    def report(self) -> Optional[Report]:
        """Facts about the reconstruction; None if another function made the mesh."""
        report = DifReport()
        status = library.dif_mesh_report(self._handle.pointer, byref(report))
        return to_dataclass(Report, report) if status == 0 else None

    def measure(self) -> Measure:
        """Counts, area, volume, box, and whether the mesh is closed and manifold."""
        measure = DifMeasure()
        check(library.dif_mesh_measure(self._handle.pointer, byref(measure)))
        result: Measure = to_dataclass(Measure, measure)
        return result

    def save(
        self,
        path: Path,
        *,
        format: Optional[str] = None,
        normals: bool = True,
        edge_ids: bool = True,
        scalars: Optional[Mapping[str, Any]] = None,
        draco: Union[bool, int] = False,
        draco_method: str = "edgebreaker",
        draco_speed: int = 5,
        normal_bits: int = 10,
        generic_bits: int = 12,
        cell_size: float = 0.0,
        color_by: Optional[str] = None,
        color_map: str = "viridis",
        color_range: Optional[Sequence[float]] = None,
        up: str = "y",
        metres_per_unit: float = 1.0,
        local_origin: Optional[Sequence[float]] = None,
        most_vertices: Optional[int] = None,
        name: Optional[str] = None,
    ) -> WriteReport:
        """Writes .ply (float64), .obj, .off, .stl, .glb, .gltf (float32) or .drc, and tells what
        was written: the file's size, counts, and by how much coordinates are off.

        difmesh/io/mesh_file.hpp says what each keeps; a library without glTF or Draco refuses
        these. The extension tells, unless `format` does: "ply" for instance. Normals and names of
        edges are written where the mesh and the format have them, unless switched off. The file
        appears when it is complete; on an error nothing is left behind.

        scalars: names to arrays (n,) of numbers to write, besides those that the mesh has, to PLY,
        glTF and Draco files.

        glTF and Draco files (.glb, .gltf, .drc):
        draco: True compresses glTF; a number, for .drc too, is that of bits per coordinate, 1 to
        24. Without it there are as many as keep coordinates within a thousandth of `cell_size`, or
        of the mean length of the triangles' edges if that is 0.
        draco_method: "edgebreaker", smallest, or "sequential", which keeps the order of points and
        faces. draco_speed: 0 small to 10 fast. normal_bits: 2 to 24. generic_bits: of scalars, 1 to
        24.

        glTF files (.glb, .gltf):
        color_by: the name of scalars to color by. color_map: "viridis", or "cool_warm", which
        diverges from 0. color_range: values of the first and the last color; all there are by
        default. up: the axis that points up, "y" or "z". metres_per_unit: the unit of the points.
        local_origin: what positions are relative to, by default the centre of their box.
        most_vertices: of a primitive; larger meshes are split. name: of mesh and node.
        """
        options = to_write_options(
            draco, color_range, local_origin, format=format, normals=bool(normals),
            edge_ids=bool(edge_ids), draco_method=draco_method, draco_speed=draco_speed,
            normal_bits=normal_bits, generic_bits=generic_bits, cell_size=cell_size,
            color_by=color_by, color_map=color_map, up=up, metres_per_unit=metres_per_unit,
            most_vertices=most_vertices, name=name,
        )  # fmt: skip
        mesh = self._with_scalars(scalars) if scalars else self
        report = DifMeshWriteReport()
        check(
            library.dif_mesh_write(
                mesh._handle.pointer, path_bytes(path), byref(options), byref(report)
            )
        )
        if report.warning is not None:
            warnings.warn(report.warning.decode(errors="replace"), Warning, stacklevel=2)
        result: WriteReport = to_dataclass(WriteReport, report)
        return result

    def _with_scalars(self, scalars: Mapping[str, Any]) -> Mesh:
        both = {**self.scalars, **scalars}
        return Mesh(self.points, self.faces, self.normals, self.edge_ids, both)

    def __repr__(self) -> str:
        return f"Mesh({len(self.points)} points, {len(self.faces)} faces)"

    def __reduce__(self) -> tuple[Any, ...]:
        return Mesh, (self.points, self.faces, self.normals, self.edge_ids, self.scalars)


def read_mesh(path: Path, *, outside_files: bool = False) -> Mesh:
    """Reads what Mesh.save() writes, told by the extension.

    What is left out of the file or taken otherwise than it says is a difmesh.Warning.
    outside_files: whether buffers of glTF may lie outside the folder of the file.
    """
    options = defaults(DifMeshReadOptions, "dif_mesh_read_options_init")
    options.outside_files = bool(outside_files)
    handle = new_mesh_handle()
    name = path_bytes(path)
    check(library.dif_mesh_read_with(name, byref(options), byref(handle.pointer)))
    warn_of(handle.pointer, library.dif_mesh_warning)
    return Mesh._from_handle(handle)


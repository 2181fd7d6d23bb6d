/// \file format_list.hpp
/// The formats of meshes, in the order in which messages list them: a line each. NAME_format is a
/// FormatPart. Included where DIFMESH_MESH_FORMAT is defined, more than once.

DIFMESH_MESH_FORMAT(ply)
DIFMESH_MESH_FORMAT(obj)
DIFMESH_MESH_FORMAT(off)
DIFMESH_MESH_FORMAT(stl)
DIFMESH_MESH_FORMAT(glb)
DIFMESH_MESH_FORMAT(gltf)
DIFMESH_MESH_FORMAT(drc)

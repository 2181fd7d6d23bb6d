#include "gltf_extensions.hpp"

#include <algorithm>
#include <array>

namespace difmesh::detail {
namespace {

constexpr std::array<std::string_view, 2> kRead{"KHR_draco_mesh_compression",
                                                "KHR_mesh_quantization"};

/// Not read, but nodes and views that have them are noticed.
constexpr std::array<std::string_view, 4> kNoticed{"EXT_mesh_gpu_instancing", "KHR_node_visibility",
                                                   "EXT_meshopt_compression",
                                                   "KHR_meshopt_compression"};

/// The beginnings of their names.
constexpr std::array<std::string_view, 28> kHarmless{"KHR_materials_",
                                                     "EXT_materials_",
                                                     "ADOBE_materials_",
                                                     "NV_materials_",
                                                     "VRMC_materials_",
                                                     "KHR_texture_",
                                                     "EXT_texture_",
                                                     "MSFT_texture_",
                                                     "MSFT_packing_",
                                                     "KHR_techniques_webgl",
                                                     "KHR_lights_",
                                                     "EXT_lights_",
                                                     "KHR_audio",
                                                     "MSFT_audio_",
                                                     "KHR_xmp",
                                                     "KHR_animation_pointer",
                                                     "KHR_interactivity",
                                                     "KHR_node_selectability",
                                                     "KHR_node_hoverability",
                                                     "EXT_mesh_features",
                                                     "EXT_structural_metadata",
                                                     "EXT_feature_metadata",
                                                     "EXT_mesh_manifold",
                                                     "MSFT_lod",
                                                     "AGI_stk_metadata",
                                                     "CESIUM_primitive_outline",
                                                     "FB_geometry_metadata",
                                                     "GODOT_single_root"};

template <class Names>
bool holds(const Names& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

ExtensionKind kind_of_extension(std::string_view name) {
  if (holds(kRead, name) || holds(kNoticed, name)) {
    return ExtensionKind::known;
  }
  const bool is_harmless =
      std::any_of(kHarmless.begin(), kHarmless.end(),
                  [name](std::string_view start) { return name.starts_with(start); });
  return is_harmless ? ExtensionKind::harmless : ExtensionKind::unknown;
}

bool can_be_required(std::string_view name) {
  return holds(kRead, name) || kind_of_extension(name) == ExtensionKind::harmless;
}

}  // namespace difmesh::detail

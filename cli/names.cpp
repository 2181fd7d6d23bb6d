#include "names.hpp"

#include <algorithm>
#include <filesystem>

namespace difmesh::cli {

bool has_extension(const std::string& path, std::span<const std::string_view> extensions) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return std::find(extensions.begin(), extensions.end(), extension) != extensions.end();
}

std::string joined(std::span<const std::string_view> words) {
  std::string text;
  for (const std::string_view word : words) {
    text += (text.empty() ? "" : ", ") + std::string(word);
  }
  return text;
}

bool is_mesh_file(const std::string& path) {
  return mesh_format_of(path) != nullptr;
}

std::vector<std::string_view> mesh_extensions(HasFormat has) {
  std::vector<std::string_view> extensions;
  for (const MeshFormat& format : mesh_formats()) {
    if (has == nullptr || has(format)) {
      extensions.push_back(format.extension);
    }
  }
  return extensions;
}

std::string mesh_extensions_text(HasFormat has) {
  return joined(mesh_extensions(has));
}

}  // namespace difmesh::cli

#pragma once
/// \file gltf_source.hpp
/// The text and the bytes of a glTF file. Nothing in it is trusted: every number is checked before
/// it is used.

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "difmesh/mesh.hpp"
#include "omissions.hpp"

namespace difmesh::detail {

/// A value of the JSON and where it is, for messages: accessors[2].count.
class JsonPlace {
 public:
  using Json = nlohmann::json;
  JsonPlace(const std::filesystem::path& file, const Json& value, std::string place)
      : file_(&file), value_(&value), place_(std::move(place)) {}

  /// \throw Error file_format: 'file': place matter
  [[noreturn]] void fail(const std::string& matter) const;
  [[nodiscard]] const Json& value() const { return *value_; }
  [[nodiscard]] const std::string& place() const { return place_; }

  [[nodiscard]] bool has(const char* key) const;
  /// The value of a key; fails where there is none, or this is no object.
  [[nodiscard]] JsonPlace at(const char* key) const;
  [[nodiscard]] JsonPlace at(std::size_t index) const;  ///< \pre index < size()
  /// Number of elements; fails unless it is an array.
  [[nodiscard]] std::size_t size() const;

  /// This as a whole number in [0, 2^53].
  [[nodiscard]] std::uint64_t whole() const;
  /// The key's, or another number where there is none.
  [[nodiscard]] std::uint64_t whole_or(const char* key, std::uint64_t otherwise) const;
  [[nodiscard]] double finite() const;
  [[nodiscard]] const std::string& text() const;
  [[nodiscard]] bool truth_or(const char* key, bool otherwise) const;

 private:
  const std::filesystem::path* file_;
  const Json* value_;
  std::string place_;
};

/// Numbers of an accessor, one row per element.
struct AccessorView {
  JsonPlace place;
  std::size_t count = 0;
  std::size_t components = 0;
  int type = 0;  ///< glTF's componentType
  bool normalized = false;
  const char* bytes = nullptr;  ///< none where the accessor has no view: Draco's, or all zero
  std::size_t stride = 0;

  [[nodiscard]] bool is_float() const { return type == 5126; }
  /// A whole number of this type, as normalisation would have it.
  [[nodiscard]] double scaled(double whole) const;
  /// Component of an element, scaled to [0,1] or [-1,1] where it is normalised.
  [[nodiscard]] double number(std::size_t element, std::size_t component) const;
  [[nodiscard]] std::uint64_t whole(std::size_t element, std::size_t component) const;
};

/// Which files a glTF file may name.
enum class OtherFiles : std::uint8_t { none, in_folder, anywhere };

class GltfSource {
 public:
  /// \param path for messages, and for what other files are relative to
  GltfSource(std::filesystem::path path, Array<char> bytes, OtherFiles files);

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] JsonPlace root() const { return {path_, json_, ""}; }
  /// Element `index` of one of the arrays of the root.
  [[nodiscard]] JsonPlace element(const char* array, const JsonPlace& index) const;
  [[nodiscard]] std::size_t count(const char* array) const;
  /// Bytes of all that was read so far.
  [[nodiscard]] std::uint64_t bytes_read() const { return bytes_read_; }

  [[nodiscard]] AccessorView accessor(const JsonPlace& index);
  [[nodiscard]] std::span<const char> view(const JsonPlace& index);

  /// What was left out of what was read so far.
  [[nodiscard]] Omissions& omissions() { return omissions_; }
  [[nodiscard]] std::vector<std::string> warnings() const;

 private:
  void parse();
  void parse_container();
  void check_is_container() const;
  std::string take_data_out();
  void check_compression(const JsonPlace& view) const;
  std::span<const char> buffer(const JsonPlace& index);
  std::span<const char> load(const std::string& uri, const JsonPlace& place);
  std::span<const char> load_file(const std::string& uri, const JsonPlace& place);

  std::filesystem::path path_;
  Array<char> bytes_;
  OtherFiles files_;
  nlohmann::json json_;
  std::string_view text_;
  std::optional<std::span<const char>> binary_;
  std::uint64_t bytes_read_ = 0;
  std::map<std::string, std::vector<char>, std::less<>> loaded_;
  std::vector<std::string_view> long_uris_;  ///< in the text, which the parser did not see
  std::vector<std::string> warnings_;
  Omissions omissions_;
};

}  // namespace difmesh::detail

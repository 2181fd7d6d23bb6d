#include "gltf_source.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "base64.hpp"
#include "difmesh/error.hpp"
#include "gltf_bytes.hpp"
#include "input_file.hpp"
#include "linked_file.hpp"
#include "text.hpp"
#include "warnings.hpp"

namespace difmesh::detail {
namespace {

constexpr std::uint64_t kMostWhole = std::uint64_t{1} << 53U;  // what JSON's readers agree on
constexpr std::size_t kMostFiles = 256;
constexpr std::size_t kMostElements = 0xFFFFFFFF;

struct ComponentType {
  int id;
  std::size_t bytes;
};
constexpr std::array<ComponentType, 6> kComponentTypes{
    {{5120, 1}, {5121, 1}, {5122, 2}, {5123, 2}, {5125, 4}, {5126, 4}}};
constexpr std::string_view kDataStart = "\"data:";
constexpr std::size_t kLongUri = 1024;
constexpr std::string_view kTaken = "data:;difmesh,";  ///< and a number
constexpr std::array<std::string_view, 4> kTypes{"SCALAR", "VEC2", "VEC3", "VEC4"};

std::uint32_t u32_at(std::span<const char> bytes, std::size_t offset) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return little_endian(value);
}

template <class T>
T number_at(const char* place) {
  T value{};
  std::memcpy(&value, place, sizeof value);
  return little_endian(value);
}

/// %20 and the like; nothing where a % is not followed by two hexadecimal digits.
std::optional<std::string> without_escapes(std::string_view uri) {
  std::string text;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    if (uri[i] != '%') {
      text += uri[i];
      continue;
    }
    constexpr std::string_view kDigits = "0123456789abcdef";
    const std::string pair = lower_case(uri.substr(i + 1, 2));
    const std::size_t high = pair.size() == 2 ? kDigits.find(pair[0]) : std::string::npos;
    const std::size_t low = pair.size() == 2 ? kDigits.find(pair[1]) : std::string::npos;
    if (high == std::string::npos || low == std::string::npos) {
      return std::nullopt;
    }
    text += static_cast<char>(16 * high + low);
    i += 2;
  }
  return text;
}

}  // namespace

void JsonPlace::fail(const std::string& matter) const {
  fail_format(*file_, (place_.empty() ? "the root" : place_) + " " + matter);
}

bool JsonPlace::has(const char* key) const {
  return value_->is_object() && value_->contains(key);
}

JsonPlace JsonPlace::at(const char* key) const {
  if (!has(key)) {
    fail(std::string("has no ") + key);
  }
  return {*file_, (*value_)[key], place_.empty() ? key : place_ + "." + key};
}

JsonPlace JsonPlace::at(std::size_t index) const {
  return {*file_, (*value_)[index], place_ + "[" + std::to_string(index) + "]"};
}

std::size_t JsonPlace::size() const {
  if (!value_->is_array()) {
    fail("is no array");
  }
  return value_->size();
}

std::uint64_t JsonPlace::whole() const {
  if (value_->is_number_unsigned() && value_->get<std::uint64_t>() <= kMostWhole) {
    return value_->get<std::uint64_t>();
  }
  // 3.0 is a whole number too.
  const double number = value_->is_number() ? value_->get<double>() : -1.0;
  if (!(number >= 0.0) || number > static_cast<double>(kMostWhole) ||
      number != std::floor(number)) {
    fail("is no whole number from 0 on");
  }
  return static_cast<std::uint64_t>(number);
}

std::uint64_t JsonPlace::whole_or(const char* key, std::uint64_t otherwise) const {
  return has(key) ? at(key).whole() : otherwise;
}

double JsonPlace::finite() const {
  if (!value_->is_number() || !std::isfinite(value_->get<double>())) {
    fail("is no number");
  }
  return value_->get<double>();
}

const std::string& JsonPlace::text() const {
  if (!value_->is_string()) {
    fail("is no text");
  }
  return value_->get_ref<const std::string&>();
}

bool JsonPlace::truth_or(const char* key, bool otherwise) const {
  if (!has(key)) {
    return otherwise;
  }
  const JsonPlace place = at(key);
  if (!place.value().is_boolean()) {
    place.fail("is neither true nor false");
  }
  return place.value().get<bool>();
}

double AccessorView::scaled(double whole) const {
  constexpr std::array<double, 4> kMost{127.0, 255.0, 32767.0, 65535.0};
  const bool is_scaled = normalized && type >= 5120 && type <= 5123;
  return is_scaled ? std::max(whole / kMost[static_cast<std::size_t>(type - 5120)], -1.0) : whole;
}

double AccessorView::number(std::size_t element, std::size_t component) const {
  if (bytes == nullptr) {
    return 0.0;
  }
  const char* const row = bytes + element * stride;
  switch (type) {
    case 5120:
      return scaled(number_at<std::int8_t>(row + component));
    case 5121:
      return scaled(number_at<std::uint8_t>(row + component));
    case 5122:
      return scaled(number_at<std::int16_t>(row + 2 * component));
    case 5123:
      return scaled(number_at<std::uint16_t>(row + 2 * component));
    case 5125:
      return number_at<std::uint32_t>(row + 4 * component);
    default:
      return static_cast<double>(number_at<float>(row + 4 * component));
  }
}

std::uint64_t AccessorView::whole(std::size_t element, std::size_t component) const {
  if (bytes == nullptr) {
    return 0;
  }
  const char* const row = bytes + element * stride;
  switch (type) {
    case 5121:
      return number_at<std::uint8_t>(row + component);
    case 5123:
      return number_at<std::uint16_t>(row + 2 * component);
    default:
      return number_at<std::uint32_t>(row + 4 * component);
  }
}

GltfSource::GltfSource(std::filesystem::path path, Array<char> bytes, OtherFiles files)
    : path_(std::move(path)), bytes_(std::move(bytes)), files_(files), bytes_read_(bytes_.size()) {
  if (bytes_.size() >= 4 && u32_at(bytes_, 0) == 0x46546C67) {
    parse_container();
  } else {
    check_is_container();
    text_ = plain_text(path_, {bytes_.data(), bytes_.size()});
  }
  parse();
}

/// A .glb: a header, a chunk of JSON, perhaps one of data, perhaps others that nobody has to know.
void GltfSource::parse_container() {
  std::span<const char> bytes(bytes_);
  if (bytes.size() < 20) {
    fail_format(path_, "truncated: a .glb file of " + std::to_string(bytes.size()) + " bytes");
  }
  if (u32_at(bytes, 4) != 2) {
    fail_format(path_, "glTF of version " + std::to_string(u32_at(bytes, 4)) + ", not 2");
  }
  const std::uint32_t length = u32_at(bytes, 8);
  if (length > bytes.size() || length < 20) {
    fail_format(path_, "its header says " + std::to_string(length) + " bytes, the file has " +
                           std::to_string(bytes.size()));
  }
  if (length < bytes.size()) {
    add_warning(warnings_, path_,
                "what follows the .glb file's own end at byte " + std::to_string(length) +
                    " was left out, " + count_of(bytes.size() - length, "byte"));
    bytes = bytes.first(length);
  }
  for (std::size_t at = 12, chunk = 0; at < bytes.size(); ++chunk) {
    if (bytes.size() - at < 8 || u32_at(bytes, at) > bytes.size() - at - 8) {
      fail_format(path_, "chunk " + std::to_string(chunk) + " reaches beyond the file");
    }
    const std::span<const char> content = bytes.subspan(at + 8, u32_at(bytes, at));
    const std::uint32_t type = u32_at(bytes, at + 4);
    if ((chunk == 0) != (type == 0x4E4F534A)) {
      fail_format(path_, "chunk " + std::to_string(chunk) + " of the .glb file is" +
                             (chunk == 0 ? " not JSON" : " JSON again"));
    }
    if (chunk == 0) {
      text_ = {content.data(), content.size()};
    } else if (type == 0x004E4942 && !binary_) {
      binary_ = content;
    }
    at += 8 + content.size();
  }
}

/// Text is welcome under the name of a .glb, but what is neither is no JSON either.
void GltfSource::check_is_container() const {
  const std::string_view start =
      trimmed({bytes_.data(), std::min<std::size_t>(bytes_.size(), 256)});
  if (extension_of(path_) == ".glb" && !start.starts_with('{') && !start.starts_with('[') &&
      !start.starts_with("\xEF\xBB\xBF")) {
    fail_format(path_, bytes_.empty() ? "no .glb file: it is empty"
                                      : "no .glb file: it starts with " +
                                            in_quotes({bytes_.data(),
                                                       std::min<std::size_t>(bytes_.size(), 4)}) +
                                            ", not 'glTF'");
  }
}

/// The text with short URIs in the place of long ones that hold data. The parser goes byte by byte,
/// and copies strings several times: 192 MB took 14 s and 1.3 GB.
std::string GltfSource::take_data_out() {
  std::string text;
  std::size_t done = 0;
  for (std::size_t at = text_.find(kDataStart); at != std::string_view::npos;
       at = text_.find(kDataStart, at + 1)) {
    const std::size_t end = text_.find('"', at + 1);
    const bool is_escaped = at > 0 && text_[at - 1] == '\\';
    if (is_escaped || end == std::string_view::npos || end - at < kLongUri) {
      continue;
    }
    const std::string_view uri = text_.substr(at + 1, end - at - 1);
    if (uri.find('\\') != std::string_view::npos) {
      continue;  // the parser knows escapes
    }
    text += text_.substr(done, at - done);
    text += '"' + std::string(kTaken) + std::to_string(long_uris_.size()) + '"';
    long_uris_.push_back(uri);
    done = end + 1;
    at = end;
  }
  return done > 0 ? text + std::string(text_.substr(done)) : text;
}

void GltfSource::parse() {
  const std::string shortened = take_data_out();
  try {
    json_ = nlohmann::json::parse(long_uris_.empty() ? text_ : std::string_view(shortened));
  } catch (const nlohmann::json::exception& error) {
    // What follows is what was read last, which may be all of the file.
    const std::string_view what = error.what();
    fail_format(path_, "no JSON: " + std::string(what.substr(0, what.find("; last read"))));
  }
  const std::string& version = root().at("asset").at("version").text();
  if (!version.starts_with("2.")) {
    fail_format(path_, "glTF of version " + in_quotes(version) + ", not 2");
  }
  if (root().at("asset").has("minVersion")) {
    const std::string& least = root().at("asset").at("minVersion").text();
    if (least != "2.0") {
      fail_format(path_,
                  "it needs a reader of glTF " + in_quotes(least) + ", and 2.0 is read here");
    }
  }
}

std::vector<std::string> GltfSource::warnings() const {
  std::vector<std::string> warnings = warnings_;
  omissions_.add_to(warnings, path_);
  return warnings;
}

std::size_t GltfSource::count(const char* array) const {
  return root().has(array) ? root().at(array).size() : 0;
}

JsonPlace GltfSource::element(const char* array, const JsonPlace& index) const {
  const std::uint64_t i = index.whole();
  if (i >= count(array)) {
    index.fail("is " + std::to_string(i) + ", but there are " + std::to_string(count(array)) + " " +
               array);
  }
  return root().at(array).at(static_cast<std::size_t>(i));
}

AccessorView GltfSource::accessor(const JsonPlace& index) {
  AccessorView view{.place = element("accessors", index)};
  const JsonPlace& place = view.place;
  if (place.has("sparse")) {
    place.fail("is sparse, which is not supported");
  }
  const auto type = std::find(kTypes.begin(), kTypes.end(), place.at("type").text());
  const std::uint64_t id = place.at("componentType").whole();
  const auto component =
      std::find_if(kComponentTypes.begin(), kComponentTypes.end(),
                   [id](const ComponentType& t) { return static_cast<std::uint64_t>(t.id) == id; });
  if (type == kTypes.end() || component == kComponentTypes.end()) {
    place.fail("is no vector of a type that vertices and indices have");
  }
  view.components = static_cast<std::size_t>(type - kTypes.begin()) + 1;
  view.type = component->id;
  view.normalized = place.truth_or("normalized", false);
  view.count = static_cast<std::size_t>(place.at("count").whole());
  if (view.count == 0) {
    place.at("count").fail("is 0");
  }
  if (!place.has("bufferView")) {
    if (view.count > kMostElements) {
      place.at("count").fail("is " + std::to_string(view.count) +
                             ", more than 32-bit indices name");
    }
    return view;
  }
  const std::span<const char> bytes = this->view(place.at("bufferView"));
  const JsonPlace view_place = element("bufferViews", place.at("bufferView"));
  const std::uint64_t row = view.components * component->bytes;
  const std::uint64_t stride = view_place.whole_or("byteStride", row);
  const std::uint64_t offset = place.whole_or("byteOffset", 0);
  if (stride < row || stride > 252) {
    view_place.fail("has a byteStride of " + std::to_string(stride) + " for elements of " +
                    std::to_string(row) + " bytes");
  }
  // Below 2^53 each, so that the sum cannot overflow.
  if (offset + (view.count - 1) * stride + row > bytes.size()) {
    place.fail("wants " + std::to_string(view.count) + " elements, beyond the " +
               std::to_string(bytes.size()) + " bytes of its bufferView");
  }
  view.bytes = bytes.data() + offset;
  view.stride = static_cast<std::size_t>(stride);
  return view;
}

/// Where the extension is not required, the buffer may hold the data as they are.
void GltfSource::check_compression(const JsonPlace& view) const {
  const JsonPlace index = view.at("buffer");
  const JsonPlace buffer = element("buffers", index);
  const bool has_data = buffer.has("uri") || (binary_ && index.whole() == 0);
  for (const char* extension : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
    if (!has_data && view.has("extensions") && view.at("extensions").has(extension)) {
      view.fail(std::string("is compressed by ") + extension + ", which is not supported");
    }
  }
}

std::span<const char> GltfSource::view(const JsonPlace& index) {
  const JsonPlace place = element("bufferViews", index);
  check_compression(place);
  const std::span<const char> bytes = buffer(place.at("buffer"));
  const std::uint64_t offset = place.whole_or("byteOffset", 0);
  const std::uint64_t length = place.at("byteLength").whole();
  if (offset + length > bytes.size()) {
    place.fail("reaches to byte " + std::to_string(offset + length) + " of a buffer of " +
               std::to_string(bytes.size()));
  }
  return bytes.subspan(static_cast<std::size_t>(offset), static_cast<std::size_t>(length));
}

std::span<const char> GltfSource::buffer(const JsonPlace& index) {
  const JsonPlace place = element("buffers", index);
  const std::uint64_t length = place.at("byteLength").whole();
  std::span<const char> bytes;
  if (place.has("uri")) {
    bytes = load(place.at("uri").text(), place.at("uri"));
  } else if (binary_ && index.whole() == 0) {
    bytes = *binary_;
  } else {
    place.fail("has neither a uri nor a chunk of the .glb file");
  }
  if (length > bytes.size()) {
    place.at("byteLength")
        .fail("is " + std::to_string(length) + ", but there are " + std::to_string(bytes.size()) +
              " bytes");
  }
  return bytes.first(static_cast<std::size_t>(length));
}

std::span<const char> GltfSource::load(const std::string& uri, const JsonPlace& place) {
  if (!lower_case(uri.substr(0, 5)).starts_with("data:")) {
    return load_file(uri, place);
  }
  const auto known = loaded_.find(place.place());
  if (known != loaded_.end()) {
    return known->second;
  }
  std::string_view text = uri;
  if (text.starts_with(kTaken)) {
    const std::optional<std::int64_t> number = to_integer(text.substr(kTaken.size()));
    if (number && *number >= 0 && *number < static_cast<std::int64_t>(long_uris_.size())) {
      text = long_uris_[static_cast<std::size_t>(*number)];
    }
  }
  const std::size_t comma = text.find(',');
  if (comma == std::string::npos || !lower_case(text.substr(0, comma)).ends_with(";base64")) {
    place.fail("holds data that are not base64");
  }
  std::optional<std::vector<char>> bytes = from_base64(text.substr(comma + 1));
  if (!bytes) {
    place.fail("holds data that are no base64");
  }
  return loaded_.emplace(place.place(), std::move(*bytes)).first->second;
}

/// Files in the folder of the glTF file or below, unless all are allowed; see linked_file.hpp.
std::span<const char> GltfSource::load_file(const std::string& uri, const JsonPlace& place) {
  const std::optional<std::string> name = without_escapes(uri);
  if (!name || name->empty() || name->find(':') != std::string::npos ||
      name->find('\0') != std::string::npos) {
    place.fail("is " + in_quotes(uri.substr(0, 80)) + ", no file in the folder");
  }
  const std::filesystem::path relative = std::filesystem::path(*name).lexically_normal();
  if (files_ == OtherFiles::none ||
      (files_ == OtherFiles::in_folder && !why_outside(relative).empty())) {
    place.fail("is " + in_quotes(uri.substr(0, 80)) + ", outside the folder of the file");
  }
  const std::string key = "file " + relative.string();
  const auto known = loaded_.find(key);
  if (known != loaded_.end()) {
    return known->second;
  }
  if (loaded_.size() >= kMostFiles) {
    place.fail("is one file too many");
  }
  const InputFile file = open_linked(path_, relative, files_ == OtherFiles::anywhere);
  const Array<char> bytes = file.read_text(0, file.size());
  bytes_read_ += bytes.size();
  return loaded_.emplace(key, std::vector<char>(bytes.begin(), bytes.end())).first->second;
}

}  // namespace difmesh::detail

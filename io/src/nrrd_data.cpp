#include "nrrd_data.hpp"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <limits>
#include <string>
#include <string_view>
#include <system_error>
#include <type_traits>

#include "elements.hpp"
#include "gzip.hpp"
#include "linked_file.hpp"
#include "memory.hpp"
#include "text.hpp"

namespace difmesh::detail {
namespace {

/// A part of the samples: which file, from where, and what is wanted of it.
struct Source {
  const InputFile& file;
  std::int64_t offset;
  std::int64_t bytes;
};

/// Bytes that may be inflated only to be skipped: other volumes of a series, or some foreign
/// header.
std::int64_t most_skipped(std::int64_t bytes) {
  constexpr std::int64_t kAlways = std::int64_t{1} << 30;
  constexpr std::int64_t kVolumes = 64;
  return std::max(kAlways, bytes > std::numeric_limits<std::int64_t>::max() / kVolumes
                               ? bytes
                               : kVolumes * bytes);
}

std::string too_short(std::int64_t wanted, std::int64_t found) {
  return "truncated: " + std::to_string(wanted) + " bytes of data wanted, " +
         std::to_string(found) + " found";
}

std::int64_t skip_lines(const InputFile& file, std::int64_t offset, std::int64_t lines) {
  while (lines > 0) {
    const Array<char> text = file.read_text(offset, 1 << 16);
    if (text.empty()) {
      fail_format(file.path(), "truncated: " + std::to_string(lines) +
                                   " lines to skip are missing before the data");
    }
    auto at = text.begin();
    while (lines > 0 && (at = std::find(at, text.end(), '\n')) != text.end()) {
      ++at;
      --lines;
    }
    offset += at - text.begin();
  }
  return offset;
}

/// Where raw data start. \throw Error file_format unless all of them are there
std::int64_t start_of_raw(const NrrdHeader& header, const Source& source) {
  const std::int64_t room = source.file.size() - source.offset;
  const std::int64_t start = header.byte_skip < 0
                                 ? source.offset + room - source.bytes
                                 : source.offset + std::min(header.byte_skip, room);
  const std::int64_t found = std::min(room, source.file.size() - start);
  if (found < source.bytes) {
    fail_format(source.file.path(), too_short(source.bytes, found));
  }
  return start;
}

void check_gzip(const NrrdHeader& header, const Source& source) {
  const std::int64_t most = most_inflated(source.file.size() - source.offset);
  const std::int64_t skip = std::max<std::int64_t>(header.byte_skip, 0);
  if (skip > most || source.bytes > most - skip) {
    fail_format(source.file.path(), too_short(source.bytes, source.file.size() - source.offset) +
                                        ", too few even for gzip");
  }
  if (skip > most_skipped(source.bytes)) {
    fail_format(source.file.path(), "'byte skip' of " + std::to_string(skip) + " is more than " +
                                        std::to_string(most_skipped(source.bytes)) +
                                        " inflated bytes that are skipped at most");
  }
}

void read_gzip(const NrrdHeader& header, const Source& source, std::byte* to) {
  if (header.byte_skip < 0) {
    inflate_end_of_file(source.file, source.offset, most_skipped(source.bytes), to, source.bytes);
  } else {
    inflate_file(source.file, source.offset, header.byte_skip, to, source.bytes);
  }
}

template <class T>
bool parse_element(std::string_view word, std::byte* to) {
  T element{};
  if constexpr (std::is_integral_v<T>) {
    word.remove_prefix(word.size() > 1 && word[0] == '+' ? 1 : 0);
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), element);
    if (error != std::errc{} || end != word.data() + word.size()) {
      return false;
    }
  } else {
    const std::optional<double> number = to_number(word);
    if (!number) {
      return false;
    }
    element = static_cast<T>(*number);
  }
  std::memcpy(to, &element, sizeof element);
  return true;
}

/// Where the text starts. \throw Error file_format where it is too short for so many numbers
std::int64_t start_of_text(const NrrdHeader& header, const Source& source) {
  if (header.byte_skip < 0) {
    fail_format(source.file.path(), "'byte skip' of -1 does not go with text");
  }
  const std::int64_t room = source.file.size() - source.offset;
  const std::int64_t start = source.offset + std::min(header.byte_skip, room);
  const std::int64_t wanted = source.bytes / size_of(header.type);
  // A number takes a digit and a space.
  if (wanted > (source.file.size() - start + 1) / 2) {
    fail_format(source.file.path(), "truncated: " + std::to_string(wanted) + " numbers wanted in " +
                                        std::to_string(source.file.size() - start) +
                                        " bytes of text");
  }
  return start;
}

void read_ascii(const NrrdHeader& header, const Source& source, std::byte* to) {
  const Array<char> text = source.file.read_text(start_of_text(header, source), source.file.size());
  const std::int64_t size = size_of(header.type);
  const std::int64_t wanted = source.bytes / size;
  constexpr std::string_view space = " \t\r\n,";
  const std::string_view view(text.data(), text.size());
  std::size_t at = 0;
  for (std::int64_t n = 0; n < wanted; ++n) {
    at = std::min(view.find_first_not_of(space, at), view.size());
    if (at == view.size()) {
      fail_format(source.file.path(), "truncated: " + std::to_string(wanted) + " numbers wanted, " +
                                          std::to_string(n) + " found");
    }
    const std::size_t end = std::min(view.find_first_of(space, at), view.size());
    const std::string_view word = view.substr(at, end - at);
    bool parsed = false;
    with_value_type(header.type,
                    [&]<class T>(T) { parsed = parse_element<T>(word, to + n * size); });
    if (!parsed) {
      fail_format(source.file.path(), "number " + std::to_string(n) + " of the data, " +
                                          in_quotes(word.substr(0, 20)) + ", is none of its type");
    }
    at = end;
  }
}

/// Holds the file against what is wanted of it, before there is memory for that.
void check_source(const NrrdHeader& header, const Source& source) {
  switch (header.encoding) {
    case NrrdEncoding::raw:
      (void)start_of_raw(header, source);
      break;
    case NrrdEncoding::gzip:
      check_gzip(header, source);
      break;
    case NrrdEncoding::ascii:
      (void)start_of_text(header, source);
      break;
  }
}

void read_source(const NrrdHeader& header, const Source& source, std::byte* to) {
  switch (header.encoding) {
    case NrrdEncoding::raw:
      source.file.read(start_of_raw(header, source), to, source.bytes);
      break;
    case NrrdEncoding::gzip:
      check_gzip(header, source);
      read_gzip(header, source, to);
      break;
    case NrrdEncoding::ascii:
      read_ascii(header, source, to);
      break;
  }
}

/// Calls action(source, part) for each part of the samples in turn.
template <class Action>
void for_sources(const InputFile& file, const NrrdHeader& header, bool outside, std::int64_t bytes,
                 const Action& action) {
  if (header.data_files.empty()) {
    action({file, skip_lines(file, header.data_offset, header.line_skip), bytes}, 0);
    return;
  }
  for (std::size_t part = 0; part < header.data_files.size(); ++part) {
    const InputFile data = open_linked(file.path(), header.data_files[part], outside);
    action({data, skip_lines(data, 0, header.line_skip), bytes}, part);
  }
}

}  // namespace

RawCells read_nrrd_data(const InputFile& file, const NrrdHeader& header, bool outside) {
  const std::int64_t bytes = bytes_promised(file.path(), header.sizes, size_of(header.type));
  const auto parts = static_cast<std::int64_t>(std::max<std::size_t>(header.data_files.size(), 1));
  const std::int64_t of_each = bytes / parts;
  for_sources(file, header, outside, of_each,
              [&](const Source& source, std::size_t) { check_source(header, source); });
  RawCells raw{header.type, header.big_endian.value_or(kBigEndianHost), false, {}};
  if (header.encoding == NrrdEncoding::ascii) {
    raw.big_endian = kBigEndianHost;
  }
  make_room(file.path(), raw.bytes, bytes);
  for_sources(file, header, outside, of_each, [&](const Source& source, std::size_t part) {
    read_source(header, source, raw.bytes.data() + static_cast<std::int64_t>(part) * of_each);
  });
  return raw;
}

}  // namespace difmesh::detail

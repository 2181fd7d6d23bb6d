#include "byte_output.hpp"

#include <algorithm>
#include <charconv>

namespace difmesh::detail {
namespace {

constexpr std::size_t kLongestNumber = 32;

}  // namespace

void ByteOutput::write_in_pieces(const void* data, std::size_t bytes) {
  const auto* from = static_cast<const char*>(data);
  while (bytes > 0) {
    make_room(1);
    const std::size_t part = std::min(bytes, buffer_.size() - used_);
    std::memcpy(buffer_.data() + used_, from, part);
    used_ += part;
    from += part;
    bytes -= part;
  }
}

void ByteOutput::write_number(double number) {
  make_room(kLongestNumber);
  const auto result =
      std::to_chars(buffer_.data() + used_, buffer_.data() + buffer_.size(), number);
  used_ = static_cast<std::size_t>(result.ptr - buffer_.data());
}

void ByteOutput::write_number(std::uint64_t number) {
  make_room(kLongestNumber);
  const auto result =
      std::to_chars(buffer_.data() + used_, buffer_.data() + buffer_.size(), number);
  used_ = static_cast<std::size_t>(result.ptr - buffer_.data());
}

void ByteOutput::write_vector(const Vec3& vector) {
  write_number(vector[0]);
  write(" ");
  write_number(vector[1]);
  write(" ");
  write_number(vector[2]);
}

void ByteOutput::make_room(std::size_t bytes) {
  if (buffer_.size() - used_ < bytes) {
    flush();
  }
}

void ByteOutput::flush() {
  drain(buffer_.data(), used_);
  drained_ += static_cast<std::int64_t>(used_);
  used_ = 0;
}

}  // namespace difmesh::detail

#include "gzip.hpp"

#include <zlib.h>

#include <algorithm>
#include <limits>
#include <new>
#include <string>
#include <vector>

#include "text.hpp"

namespace difmesh::detail {
namespace {

constexpr std::size_t kChunk = std::size_t{1} << 16;
constexpr int kGzipWindow = 15 + 16;  // zlib: the largest window, gzip wrapper
constexpr int kAnyWindow = 15 + 32;   // gzip or zlib wrapper, by the first bytes

/// zlib's inflate over a file, a piece of output at a time.
class Inflater {
 public:
  Inflater(const InputFile& file, std::int64_t offset) : file_(file), offset_(offset) {
    if (inflateInit2(&stream_, kAnyWindow) != Z_OK) {
      throw std::bad_alloc();
    }
  }
  ~Inflater() { inflateEnd(&stream_); }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;

  /// Bytes written to `to`, fewer than wanted only at the end of the stream.
  std::int64_t read(std::byte* to, std::int64_t wanted) {
    std::int64_t done = 0;
    while (done < wanted && !at_end_) {
      const auto part = static_cast<uInt>(std::min<std::int64_t>(wanted - done, 1 << 30));
      stream_.next_out = reinterpret_cast<Bytef*>(to + done);
      stream_.avail_out = part;
      refill();
      step();
      done += part - stream_.avail_out;
    }
    return done;
  }

 private:
  void refill() {
    if (stream_.avail_in == 0) {
      input_ = file_.read_text(offset_, static_cast<std::int64_t>(kChunk));
      offset_ += static_cast<std::int64_t>(input_.size());
      stream_.next_in = reinterpret_cast<Bytef*>(input_.data());
      stream_.avail_in = static_cast<uInt>(input_.size());
    }
  }

  void step() {
    const bool no_more = stream_.avail_in == 0;
    const int result = inflate(&stream_, Z_NO_FLUSH);
    if (result == Z_STREAM_END) {
      start_member();
    } else if (result == Z_MEM_ERROR) {
      throw std::bad_alloc();
    } else if (result == Z_BUF_ERROR && no_more) {
      fail_format(file_.path(), "truncated: the gzip stream breaks off at the end of the file");
    } else if (result != Z_OK && result != Z_BUF_ERROR) {
      fail_format(file_.path(), std::string("damaged gzip stream: ") +
                                    (stream_.msg != nullptr ? stream_.msg : "no gzip data"));
    }
  }

  /// At the end of one member: goes on if another follows.
  void start_member() {
    if (stream_.avail_in < 2) {
      offset_ -= stream_.avail_in;
      stream_.avail_in = 0;
      refill();
    }
    at_end_ = stream_.avail_in < 2 || stream_.next_in[0] != 0x1f || stream_.next_in[1] != 0x8b;
    if (!at_end_) {
      inflateReset(&stream_);
    }
  }

  const InputFile& file_;
  std::int64_t offset_;
  Array<char> input_;
  z_stream stream_{};
  bool at_end_ = false;
};

}  // namespace

void inflate_file(const InputFile& file, std::int64_t offset, std::int64_t skip, std::byte* to,
                  std::int64_t bytes) {
  Inflater inflater(file, offset);
  std::vector<std::byte> waste(kChunk);
  for (std::int64_t left = skip; left > 0;) {
    const std::int64_t part = std::min(left, static_cast<std::int64_t>(kChunk));
    if (inflater.read(waste.data(), part) != part) {
      fail_format(file.path(), "truncated: the gzip stream ends before byte " +
                                   std::to_string(skip) + ", where the data should start");
    }
    left -= part;
  }
  const std::int64_t found = inflater.read(to, bytes);
  if (found != bytes) {
    fail_format(file.path(), "truncated: the gzip stream holds " + std::to_string(found) +
                                 " bytes, " + std::to_string(bytes) + " wanted");
  }
  // Rejects further bytes; asking for one also has the checksum looked at.
  if (inflater.read(waste.data(), 1) != 0) {
    fail_format(file.path(), "too long: the gzip stream holds more than the " +
                                 std::to_string(bytes) + " bytes wanted");
  }
}

void inflate_end_of_file(const InputFile& file, std::int64_t offset, std::int64_t most_before,
                         std::byte* to, std::int64_t bytes) {
  Inflater inflater(file, offset);
  // Written round and round, then turned so that the oldest byte comes first.
  std::int64_t before = -bytes;
  std::int64_t at = 0;
  for (std::int64_t wanted = bytes, found = bytes; found == wanted; before += found) {
    if (before > most_before) {
      fail_format(file.path(), "the gzip stream holds more than " + std::to_string(most_before) +
                                   " bytes before the data");
    }
    at = at == bytes ? 0 : at;
    wanted = std::min(bytes - at, std::int64_t{1} << 24);
    found = inflater.read(to + at, wanted);
    at += found;
  }
  if (before < 0) {
    fail_format(file.path(), "truncated: the gzip stream holds " + std::to_string(before + bytes) +
                                 " bytes, " + std::to_string(bytes) + " wanted");
  }
  std::rotate(to, to + at % bytes, to + bytes);
}

std::int64_t most_inflated(std::int64_t compressed) {
  // Two bits of deflate stand for at most 258 bytes: 1032 to 1.
  constexpr std::int64_t ratio = 1032;
  constexpr std::int64_t largest = std::numeric_limits<std::int64_t>::max();
  return compressed > largest / ratio ? largest : compressed * ratio;
}

struct GzipWriter::Stream {
  z_stream z{};
  std::vector<Bytef> output = std::vector<Bytef>(kChunk);
};

GzipWriter::GzipWriter(AtomicFile& file, int level)
    : file_(file), stream_(std::make_unique<Stream>()) {
  if (deflateInit2(&stream_->z, level, Z_DEFLATED, kGzipWindow, 8, Z_DEFAULT_STRATEGY) != Z_OK) {
    throw std::bad_alloc();
  }
}

GzipWriter::~GzipWriter() {
  deflateEnd(&stream_->z);
}

void GzipWriter::write(const std::byte* data, std::size_t bytes) {
  while (bytes > 0) {
    const std::size_t part = std::min(bytes, std::size_t{1} << 30);
    stream_->z.next_in = reinterpret_cast<Bytef*>(const_cast<std::byte*>(data));
    stream_->z.avail_in = static_cast<uInt>(part);
    deflate_all(Z_NO_FLUSH);
    data += part;
    bytes -= part;
  }
}

void GzipWriter::finish() {
  deflate_all(Z_FINISH);
}

void GzipWriter::deflate_all(int flush) {
  z_stream& z = stream_->z;
  do {
    z.next_out = stream_->output.data();
    z.avail_out = static_cast<uInt>(stream_->output.size());
    deflate(&z, flush);
    file_.write(stream_->output.data(), stream_->output.size() - z.avail_out);
  } while (z.avail_out == 0);
}

}  // namespace difmesh::detail

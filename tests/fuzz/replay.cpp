// Runs a fuzz target over files, so that inputs that once did harm, and some of every kind, are
// tried in every build and by every compiler. Arguments: files or folders of files.

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

void run(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  // A copy of exactly this size, for the sanitizer to guard.
  const std::vector<std::uint8_t> data(bytes.begin(), bytes.end());
  LLVMFuzzerTestOneInput(data.data(), data.size());
}

}  // namespace

int main(int argc, char** argv) {
  int count = 0;
  for (int n = 1; n < argc; ++n) {
    if (std::filesystem::is_directory(argv[n])) {
      for (const auto& entry : std::filesystem::directory_iterator(argv[n])) {
        run(entry.path());
        ++count;
      }
    } else {
      run(argv[n]);
      ++count;
    }
  }
  std::printf("%d inputs\n", count);
  return count > 0 ? 0 : 1;
}

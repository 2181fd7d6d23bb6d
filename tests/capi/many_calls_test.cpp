// Programs that live long: short calls without end, as a flow solver makes them.

#include <doctest/doctest.h>
#include <unistd.h>

#include <atomic>
#include <cstdint>
#include <fstream>
#include <thread>
#include <vector>

#include "handles.hpp"

namespace {

namespace c = difmesh::test;

/// In memory now, in MiB, as Linux says; 0 where nothing says.
[[maybe_unused]] double resident() {
  std::ifstream file("/proc/self/statm");
  double pages = 0.0;
  double in_memory = 0.0;
  file >> pages >> in_memory;
  return file ? in_memory * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1048576.0 : 0.0;
}

void reconstruct(const c::OwnedField& field, std::int32_t threads) {
  dif_options options = c::prepared(dif_options_init);
  options.threads = threads;
  options.placement = DIF_PLACEMENT_LINEAR;  // short, or the pile has time to go
  static_cast<void>(c::c_reconstruct(c::c_field(field), &options));
}

}  // namespace

TEST_CASE("short calls one after another take no more and more memory") {
  const c::OwnedField field = c::white_noise({4, 4, 4}, 3);
  const auto call = [&](int times) {
    for (int n = 0; n < times; ++n) {
      reconstruct(field, n % 3);
    }
  };
  call(500);
  [[maybe_unused]] const double before = resident();
  call(15000);
#ifndef DIFMESH_SANITIZED  // which keep what is freed for a while
  CHECK(resident() - before < 8.0);
#endif
}

TEST_CASE("more calls at once than there are cores are all served") {
  const c::OwnedField field = c::white_noise({9, 8, 7}, 4);
  std::atomic<int> served{0};
  std::vector<std::thread> callers;
  for (int n = 0; n < 80; ++n) {
    callers.emplace_back([&, n] {
      reconstruct(field, n % 4);
      ++served;
    });
  }
  for (std::thread& caller : callers) {
    caller.join();
  }
  CHECK(served == 80);
}

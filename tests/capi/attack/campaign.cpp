#include "campaign.hpp"

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "shrink.hpp"
#include "specimen.hpp"

namespace difmesh::attack {
namespace {

struct Arguments {
  std::uint64_t first = 1;
  std::uint64_t step = 1;
  std::uint64_t fields = 100000;
  double seconds = 1e18;
  std::uint64_t most_findings = 1;  // of a kind
  bool replays = false;
};

std::optional<Arguments> read_arguments(int argc, char** argv) {
  Arguments arguments;
  for (int n = 1; n < argc; n += 2) {
    const std::string_view name = argv[n];
    char* end = nullptr;
    const std::uint64_t count = n + 1 < argc ? std::strtoull(argv[n + 1], &end, 10) : 0;
    if (end == nullptr || end == argv[n + 1] || *end != '\0') {
      return std::nullopt;
    }
    if (name == "--seed") {
      arguments.first = count;
      arguments.fields = 1;
      arguments.replays = true;
    } else if (name == "--fields") {
      arguments.fields = count;
    } else if (name == "--first") {
      arguments.first = count;
    } else if (name == "--step") {
      arguments.step = count;
    } else if (name == "--seconds") {
      arguments.seconds = static_cast<double>(count);
    } else if (name == "--most-findings") {
      arguments.most_findings = count;
    } else {
      return std::nullopt;
    }
  }
  return arguments;
}

class Campaign {
 public:
  Campaign(const Arguments& arguments, const FurtherCheck& further)
      : arguments_(arguments), further_(further) {}

  int run() {
    for (; done_ < arguments_.fields && elapsed() <= arguments_.seconds; ++done_) {
      tell_progress();
      const Specimen specimen = make_specimen(arguments_.first + done_ * arguments_.step);
      if (arguments_.replays) {
        std::printf("%s", dump(specimen).c_str());
      }
      const Finding finding = attack(specimen);
      refused_ += trial_.mesh() == nullptr ? 1U : 0U;
      triangles_ += trial_.triangles();
      if (finding && ++findings_[finding.kind] <= arguments_.most_findings) {
        tell(specimen, finding);
      }
    }
    for (const auto& [kind, count] : findings_) {
      std::printf("%llu x %s\n", count, kind.c_str());
    }
    std::printf("attack: %llu fields (%llu rightly refused, %llu triangles) in %.1f s: %s\n", done_,
                refused_, triangles_, elapsed(),
                findings_.empty() ? "nothing is wrong" : "SOMETHING IS WRONG");
    return findings_.empty() ? 0 : 1;
  }

 private:
  using Count = unsigned long long;

  [[nodiscard]] double elapsed() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }
  Finding attack(const Specimen& specimen) {
    Finding finding = trial_.run(specimen);
    return finding || !further_ || trial_.mesh() == nullptr ? finding : further_(trial_);
  }
  void tell_progress() {
    if (elapsed() > told_ + 60.0) {
      told_ = elapsed();
      std::fprintf(stderr,
                   "attack from seed %llu on: %llu fields in %.0f s, %zu kinds of findings\n",
                   Count{arguments_.first}, done_, told_, findings_.size());
    }
  }
  void tell(const Specimen& specimen, const Finding& finding) {
    const auto again = [this](const Specimen& other) { return attack(other); };
    const Specimen small = shrunk(again, specimen, finding.kind);
    std::printf("seed %llu: %s: %s\n-- made small: %s\n%s\n", Count{specimen.seed}, finding.kind,
                finding.detail.c_str(), attack(small).detail.c_str(), dump(small).c_str());
    std::fflush(stdout);
  }

  Arguments arguments_;
  const FurtherCheck& further_;
  Trial trial_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::map<std::string, Count> findings_;
  Count done_ = 0;
  Count refused_ = 0;
  Count triangles_ = 0;
  double told_ = 0.0;
};

}  // namespace

int run_campaign(int argc, char** argv, const FurtherCheck& further) {
  const std::optional<Arguments> arguments = read_arguments(argc, argv);
  if (!arguments) {
    std::fprintf(stderr,
                 "usage: %s [--fields N] [--first SEED] [--step N] [--seconds S] "
                 "[--most-findings N]\n       %s --seed SEED\n",
                 argv[0], argv[0]);
    return 2;
  }
  return Campaign(*arguments, further).run();
}

}  // namespace difmesh::attack

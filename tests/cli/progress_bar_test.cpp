#include "progress_bar.hpp"

#include <doctest/doctest.h>

#include <sstream>
#include <string>

namespace {

using difmesh::cli::ProgressBar;

/// A bar whose time is set by hand.
struct Desk {
  std::ostringstream screen;
  double seconds = 100.0;
  ProgressBar bar;

  explicit Desk(int columns = 80, const std::string& label = "working")
      : bar(screen, label, columns, [this] { return seconds; }) {}

  /// What is written by one update.
  std::string update(double after, double share) {
    screen.str("");
    seconds += after;
    bar.update(share);
    return screen.str();
  }
};

/// What a terminal shows on a line after these characters.
std::string shown(const std::string& written) {
  std::string line;
  std::size_t cursor = 0;
  for (const char c : written) {
    if (c == '\r') {
      cursor = 0;
    } else {
      line.resize(std::max(line.size(), cursor + 1), ' ');
      line[cursor++] = c;
    }
  }
  line.erase(line.find_last_not_of(' ') + 1);
  return line;
}

}  // namespace

TEST_CASE("the bar is silent in the first second") {
  Desk desk;
  CHECK(desk.update(0.0, 0.1).empty());
  CHECK(desk.update(0.9, 0.5).empty());
  CHECK(shown(desk.update(0.2, 0.5)).starts_with("working ["));
}

TEST_CASE("the bar shows share and seconds") {
  Desk desk;
  CHECK(shown(desk.update(12.3, 0.25)) ==
        "working [" + std::string(10, '#') + std::string(30, '.') + "]  25 %  12 s");
  CHECK(shown(desk.update(50.0, 1.0)) == "working [" + std::string(40, '#') + "] 100 %  62 s");
}

TEST_CASE("the bar is drawn at most ten times a second") {
  Desk desk;
  CHECK(!desk.update(2.0, 0.1).empty());
  CHECK(desk.update(0.06, 0.2).empty());
  CHECK(!desk.update(0.06, 0.3).empty());
}

TEST_CASE("the bar leaves the last column free and shrinks to what there is") {
  for (int columns = 0; columns < 120; ++columns) {
    CAPTURE(columns);
    Desk desk(columns);
    const std::string line = shown(desk.update(2.0, 0.5));
    CHECK(line.size() <= static_cast<std::size_t>(std::max(columns - 1, 0)));
    if (columns >= 40) {
      CHECK(line.find('#') != std::string::npos);
    }
    if (columns >= 22) {
      CHECK(line.find("50 %  2 s") != std::string::npos);
    }
  }
}

TEST_CASE("an erased bar leaves an empty line and shorter text nothing behind") {
  Desk desk;
  std::string written = desk.update(999.95, 0.1);
  desk.screen.str("");
  desk.bar.erase();
  CHECK(shown(written + desk.screen.str()).empty());
  CHECK(desk.screen.str().back() == '\r');
  desk.screen.str("");
  desk.bar.erase();
  CHECK(desk.screen.str().empty());
}

TEST_CASE("a bar that was never drawn erases nothing") {
  std::ostringstream screen;
  {
    ProgressBar bar(screen, "working", 80, [] { return 0.0; });
    bar.update(0.5);
  }
  CHECK(screen.str().empty());
}

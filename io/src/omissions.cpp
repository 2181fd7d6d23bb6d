#include "omissions.hpp"

#include "text.hpp"
#include "warnings.hpp"

namespace difmesh::detail {

void Omissions::note(const std::string& place, const std::string& what) {
  for (Kind& kind : kinds_) {
    if (kind.what == what) {
      ++kind.others;
      return;
    }
  }
  kinds_.push_back({place, what});
}

void Omissions::add_to(std::vector<std::string>& warnings,
                       const std::filesystem::path& path) const {
  for (const Kind& kind : kinds_) {
    std::string matter = kind.place + " " + kind.what;
    if (kind.others > 0) {
      matter += ", as in " + count_of(kind.others, "other place");
    }
    add_warning(warnings, path, matter);
  }
}

}  // namespace difmesh::detail

#include "sections.hpp"

namespace difmesh::detail {

ByteOutput& Sections::at(std::size_t section) {
  if (section == current_) {
    return file_;
  }
  Part& part = parts_[section];
  if (part.spool == nullptr) {
    part.spool = file_.spool();
  }
  return *part.spool;
}

void Sections::close(std::size_t section) {
  parts_[section].is_closed = true;
  while (current_ < parts_.size() && parts_[current_].is_closed) {
    ++current_;
    if (current_ < parts_.size() && parts_[current_].spool != nullptr) {
      parts_[current_].spool->copy_to(file_);
      parts_[current_].spool.reset();
    }
  }
}

}  // namespace difmesh::detail

#include "base/kept_by_reports.hpp"

namespace graze {

KeptByReportsHandle::KeptByReportsHandle(const KeptByReports* kept) noexcept : kept_(kept) {
  if (kept_ != nullptr) kept_->add_holder();
}

KeptByReportsHandle::~KeptByReportsHandle() {
  if (kept_ != nullptr) kept_->drop_holder();
}

}  // namespace graze

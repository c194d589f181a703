#include "jobs/last_contacts.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "objects/mapped_feature.hpp"
#include "report/contact_key.hpp"

namespace graze {

namespace {

/// The two features of a contact, of which the lower comes first for an object with itself.
std::pair<Feature, Feature> in_order(const PairJob& job, const Feature& a, const Feature& b) {
  return job.is_of_self() && b < a ? std::pair(b, a) : std::pair(a, b);
}

}  // namespace

void LastContacts::begin(const FrameReport& last, std::span<const PairJob> jobs, bool some_replaced) {
  last_ = &last;
  jobs_ = jobs;
  mapped_.clear();
  contacts_.clear();
  if (!some_replaced) return;
  for (std::size_t job = 0; job < jobs.size(); ++job)
    if (jobs[job].last != nullptr && jobs[job].speaks_of_replaced()) map(job);
}

void LastContacts::map(std::size_t job) {
  const auto begin = static_cast<std::ptrdiff_t>(contacts_.size());
  for (Contact contact : last_->contacts(*jobs_[job].last)) {
    const auto a = mapped_feature(*jobs_[job].a, contact.feature_a);
    const auto b = mapped_feature(*jobs_[job].b, contact.feature_b);
    if (!a || !b) continue;
    std::tie(contact.feature_a, contact.feature_b) = in_order(jobs_[job], *a, *b);
    contacts_.push_back(contact);
  }
  std::sort(contacts_.begin() + begin, contacts_.end(), [](const Contact& left, const Contact& right) {
    return std::tuple(key_of(left), left.since) < std::tuple(key_of(right), right.since);
  });
  contacts_.erase(
      std::unique(contacts_.begin() + begin, contacts_.end(),
                  [](const Contact& left, const Contact& right) { return key_of(left) == key_of(right); }),
      contacts_.end());
  const auto first = static_cast<std::size_t>(begin);
  mapped_.push_back({job, first, contacts_.size() - first});
}

std::span<const Contact> LastContacts::of(std::size_t job) const {
  const auto mapped =
      std::lower_bound(mapped_.begin(), mapped_.end(), job,
                       [](const Mapped& each, std::size_t value) { return each.job < value; });
  if (mapped != mapped_.end() && mapped->job == job)
    return std::span(contacts_).subspan(mapped->begin, mapped->count);
  return jobs_[job].last == nullptr ? std::span<const Contact>() : last_->contacts(*jobs_[job].last);
}

Witness mapped_witness(const PairJob& job) {
  Witness witness = job.last->witness;
  const auto map = [](const Object& object, Feature& feature) {
    feature = mapped_feature(object, feature).value_or(Feature{FeatureKind::vertex, Mesh::no_vertex});
  };
  map(*job.a, witness.feature_a);
  map(*job.b, witness.feature_b);
  return witness;
}

}  // namespace graze

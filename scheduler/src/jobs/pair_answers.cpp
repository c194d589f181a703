#include "jobs/pair_answers.hpp"

#include "core/base/bytes_of.hpp"

namespace graze {
namespace {

/// All of an answer but its lists.
const PairFinding& finding_of(const PairAnswer& answer) {
  return answer;
}

}  // namespace

void PairAnswers::begin(std::size_t count) {
  if (answers_.size() < count) answers_.resize(count);
  contacts_.begin();
  region_distances_.begin();
}

void PairAnswers::keep(std::size_t job, const PairAnswer& answer, unsigned worker) {
  answers_[job] = {finding_of(answer), contacts_.keep(answer.contacts, worker),
                   region_distances_.keep(answer.region_distances, worker)};
}

void PairAnswers::keep_without_contacts(std::size_t job, const PairAnswer& answer, unsigned worker) {
  answers_[job] = {finding_of(answer), {}, region_distances_.keep(answer.region_distances, worker)};
  answers_[job].contacts_left_out = static_cast<std::uint32_t>(answer.contacts.size());
}

void PairAnswers::repeat_without_contacts(std::size_t job, std::size_t contacts) {
  answers_[job] = {};
  answers_[job].contacts_left_out = static_cast<std::uint32_t>(contacts);
}

void PairAnswers::set_contacts(std::size_t job, std::span<const Contact> contacts) {
  answers_[job].contacts = contacts;
  answers_[job].contacts_left_out -= static_cast<std::uint32_t>(contacts.size());
}

void PairAnswers::refer_to(std::size_t job, const PairAnswer& answer) {
  answers_[job] = {finding_of(answer), answer.contacts, answer.region_distances};
}

void PairAnswers::grow_to_demand() {
  contacts_.grow_to_demand();
  region_distances_.grow_to_demand();
}

void PairAnswers::reserve(std::size_t answers, std::size_t contacts, std::size_t region_distances) {
  if (answers_.size() < answers) answers_.resize(answers);
  contacts_.reserve(contacts);
  region_distances_.reserve(region_distances);
}

std::size_t PairAnswers::byte_count() const {
  return bytes_of(answers_) + contacts_.byte_count() + region_distances_.byte_count();
}

}  // namespace graze

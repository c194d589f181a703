#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace graze {

/// A vector without memory on the heap: at most `capacity` elements, held inside it.
template <typename Element, std::size_t capacity>
class InplaceVector {
 public:
  InplaceVector() = default;
  InplaceVector(const InplaceVector& other) { *this = other; }
  // Elements behind the size were never written and are not copied.
  InplaceVector& operator=(const InplaceVector& other) {
    if (this != &other) std::copy(other.begin(), other.end(), begin());
    size_ = other.size_;
    return *this;
  }
  ~InplaceVector() = default;

  /// Returns false and leaves the list as it is where it is full.
  bool push_back(const Element& element) {
    if (size_ == capacity) return false;
    elements_[size_++] = element;
    return true;
  }
  [[nodiscard]] const Element& back() const { return elements_[size_ - 1]; }
  void pop_back() { --size_; }
  void clear() { size_ = 0; }
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] bool empty() const { return size_ == 0; }
  [[nodiscard]] Element& operator[](std::size_t index) { return elements_[index]; }
  [[nodiscard]] const Element& operator[](std::size_t index) const { return elements_[index]; }
  [[nodiscard]] Element* begin() { return elements_.data(); }
  [[nodiscard]] Element* end() { return begin() + size_; }
  [[nodiscard]] const Element* begin() const { return elements_.data(); }
  [[nodiscard]] const Element* end() const { return begin() + size_; }

 private:
  std::array<Element, capacity> elements_;
  std::size_t size_ = 0;
};

}  // namespace graze

#pragma once

/// @file
/// A header for the self-test of reference_test.py. Each line that ends in "wrong" has to be complained of.

#define UNDOCUMENTED_MACRO 1  // wrong

/// A namespace.
namespace example {

/// Has a comment, but its enumerators have none.
enum class Bare { first };  // wrong

/// A documented enumeration.
enum class Fine {
  one,  ///< The first one.
};

struct Silent {};  // wrong

/// A class.
class Documented {
 public:
  Documented() = default;  // wrong
  int member = 0;          // wrong
  void call();             // wrong
  /// Returns what it gets. Refers to Fine::one and call().
  int good(int value);
  /// Refers to Fine::two, which is not there.                  // wrong
  void names_no_enumerator();
  /// Refers to nothing_like_it().                              // wrong
  void names_no_function();
  /// Refers to `nowhere`.                                      // wrong
  void names_no_word();
  /// Refers to docs/no_such_page.md.                           // wrong
  void names_no_page();
  /// Refers to a member that is not there: @ref Documented::gone.  // wrong
  void has_a_broken_link();

 private:
  int secret_ = 0;
};

void free_function();  // wrong

using Alias = int;  // wrong

template <typename Type>
concept Anything = true;  // wrong

/// @cond
struct Hidden {
  int member;
};
/// @endcond

}  // namespace example

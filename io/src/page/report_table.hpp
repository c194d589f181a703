#pragma once

#include <cstdint>
#include <functional>
#include <graze/report.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "page/page_table.hpp"
#include "text/json_text.hpp"

namespace graze::io {

/// Rows with some numbers each, which are kept by columns.
class PageColumns {
 public:
  /// One column: `row_numbers` numbers of one type in each row.
  struct Column {
    std::string_view name;
    std::string_view type;
    std::size_t number_bytes = 0;
    std::size_t row_numbers = 0;
    std::string bytes{};
  };

  explicit PageColumns(std::vector<Column> columns) : columns_(std::move(columns)) {}

  /// Begins a row. put() then fills the columns one after the other.
  PageColumns& begin_row();
  template <typename Number>
  PageColumns& put(Number number) {
    append_little_endian(columns_[next_].bytes, number);
    if (++filled_ == columns_[next_].row_numbers) {
      filled_ = 0;
      ++next_;
    }
    return *this;
  }
  [[nodiscard]] std::size_t size() const { return rows_; }
  /// Whether `count` rows from `a` on have the same bits as those from `b` on.
  [[nodiscard]] bool are_same(std::size_t a, std::size_t b, std::size_t count) const;
  /// Leaves out the last rows.
  void truncate(std::size_t rows);
  void add_to(PageTable& table) const;

 private:
  std::vector<Column> columns_;
  std::size_t rows_ = 0;
  std::size_t next_ = 0;    ///< the column that is filled
  std::size_t filled_ = 0;  ///< how many numbers of its row it has
};

/// Rows that belong to pairs: each pair has a list of them.
class PairLists {
 public:
  using Numbers = std::vector<std::uint32_t>;

  explicit PairLists(std::vector<PageColumns::Column> columns) : rows_(std::move(columns)) {}

  /// The rows, to which those of the next pair are added.
  PageColumns& rows() { return rows_; }
  [[nodiscard]] const PageColumns& rows() const { return rows_; }
  /// Ends the list of a pair.
  void end_pair() { begins_.push_back(static_cast<std::uint32_t>(rows_.size())); }
  /// The row at which the list of a pair begins. For the number of pairs it is the end of the last list.
  [[nodiscard]] std::uint32_t begin(std::size_t pair) const { return begins_[pair]; }
  /// The rows at which the lists of all pairs begin.
  [[nodiscard]] std::span<const std::uint32_t> begins() const {
    return std::span(begins_).first(begins_.size() - 1);
  }
  /// The rows after the lists of all pairs.
  [[nodiscard]] std::span<const std::uint32_t> ends() const { return std::span(begins_).subspan(1); }
  /// The pairs that have rows.
  [[nodiscard]] Numbers pairs() const;
  /// Whether the lists of `count` pairs from `a` on have the same bits as those from `b` on.
  [[nodiscard]] bool are_same(std::size_t a, std::size_t b, std::size_t count) const;
  /// Keeps the lists of the first pairs alone.
  void truncate(std::size_t pairs);

 private:
  PageColumns rows_;
  Numbers begins_{0};
};

/// Collects the reports of a block.
class ReportBlock {
 public:
  /// Gives the index of an object in the page, or nothing for an id that the page has not.
  using IndexOf = std::function<std::optional<std::uint32_t>(ObjectId)>;

  ReportBlock();

  /// Appends a report, of whose pairs the page has all objects. `number` is the source's number of the frame,
  /// `page_frame` the page's.
  void add(std::uint64_t page_frame, std::uint64_t number, const FrameReport& report, const IndexOf& index_of,
           bool include_times);
  /// The table of all reports.
  [[nodiscard]] std::string table() const;

 private:
  struct Range {
    std::size_t begin = 0;
    std::size_t end = 0;
  };

  void add_pair(std::uint64_t number, const FrameReport& report, const PairReport& pair,
                const IndexOf& index_of);
  void add_diagnostics(std::uint64_t page_frame, const FrameReport& report, const IndexOf& index_of);
  void add_info(std::uint64_t number, const FrameReport& report, bool include_times);
  /// Whether the rows from `rows.begin` on say what those of the last frame say.
  [[nodiscard]] bool repeat_last(const Range& rows) const;
  void truncate_pairs(std::size_t count);
  void add_sweeps_to(PageTable& table) const;

  std::vector<Range> frames_;  ///< of each, its pairs
  PageColumns pairs_;
  Range last_;  ///< the pairs of the last frame
  PairLists contacts_;
  PairLists regions_;
  PairLists ways_;     ///< a row for each pair that has a way out
  PairLists sweeps_;   ///< a row for each pair that met or came near between two steps
  PairLists impacts_;  ///< only such pairs have any
  JsonText diagnostics_;
  JsonText infos_;
};

}  // namespace graze::io

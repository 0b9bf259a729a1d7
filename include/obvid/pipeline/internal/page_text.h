// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "obvid/core/internal/data_table.h"

namespace obvid {

/// A page for a report: verdict, pictures, figures, tables. One HTML file that needs no other.
struct ReportPage {
  enum class Verdict { kNeutral, kKept, kBroken };
  using Figures = std::vector<std::pair<std::string, std::string>>;  ///< label, value

  std::string title;
  std::string verdict;
  Verdict kind = Verdict::kNeutral;
  std::vector<std::string> pictures{};  ///< SVG files
  Figures figures{};
  std::vector<std::string> warnings{};  ///< below the verdict
  std::vector<std::string> notes{};     ///< below the tables: what they mean, what else is known
  std::vector<std::string> tables{};    ///< HTML, as the functions below make them
};

/// The page. Names and values may hold any characters; pictures and tables are taken as they are.
[[nodiscard]] std::string page_text(const ReportPage& page);

/// A table whose first column says what the second one is.
[[nodiscard]] std::string figures_of_page(const ReportPage::Figures& figures);

/// A table of rows, none without rows. Figures have ten digits at most, texts are as they are,
/// empty cells are "-". Of long tables the first thousand rows, which the caption says.
[[nodiscard]] std::string table_of_page(std::string_view id, std::string_view caption,
                                        const DataTable& table);

}  // namespace obvid

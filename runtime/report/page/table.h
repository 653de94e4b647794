#pragma once

#include <optional>
#include <string>
#include <vector>

namespace gazeloop::report::page {

/// A head of a column. Where it stands for a frame, the plots can be moved there.
struct TableHead {
    std::string text;
    std::optional<double> show_s{};  ///< seconds on the plots' axis
};

struct TableRow {
    std::string label;
    std::vector<std::string> cells{};
    std::string key{};      ///< of the quantity, for programs
    bool indented = false;  ///< a part of what stands above
    bool heading = false;   ///< names the rows that follow; has no cells
    std::optional<double> show_s{};
};

/// A table as a page shows it. Its columns: labels, then what the heads after the first one say.
struct Table {
    std::vector<TableHead> heads;
    std::vector<TableRow> rows;
    bool text = false;   ///< the cells are words, not figures
    bool tight = false;  ///< many columns
};

}  // namespace gazeloop::report::page

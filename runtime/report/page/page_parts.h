#pragma once

#include <initializer_list>
#include <kainjow/mustache.hpp>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/report/page/table.h"

namespace gazeloop::report::page {

using kainjow::mustache::data;

/// What pages are made of, as their *.mustache files ask for it. Texts are any bytes: what they
/// hold is shown, and never becomes a part of the page's own language.

[[nodiscard]] inline data list() { return data(data::type::list); }
/// A list of items with a "text" each.
[[nodiscard]] data texts(const std::vector<std::string>& lines);
[[nodiscard]] data table_data(const Table& table);

/// A plot with the table that holds its numbers.
struct Figure {
    std::string id;  ///< by which a script finds it
    std::string title;
    std::string note;
    Table table;
    bool moves = true;  ///< over time: the reader chooses which
};
[[nodiscard]] data figure_data(const Figure& figure);

/// JSON that may stand inside a script element: nothing in it ends one.
[[nodiscard]] std::string script_json(const nlohmann::ordered_json& json);

/// The style, Chart.js with its licence, these scripts one after the other, and the version.
void add_style_and_scripts(data& page, std::initializer_list<std::string_view> scripts);

/// The file with the page's data in it. Throws std::logic_error where the file is no template.
[[nodiscard]] std::string rendered(std::string_view mustache_file, data& page);

}  // namespace gazeloop::report::page

#include "runtime/report/page/page_parts.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>

#include "runtime/report/page/page_files.h"
#include "runtime/version.h"

namespace gazeloop::report::page {
namespace {

std::string file_text(std::string_view name) { return std::string(page_file(name)); }

void add_show(data& item, const std::optional<double>& show_s) {
    if (show_s) {
        item.set("show", fmt::format("{:.5f}", *show_s));
    }
}

}  // namespace

data texts(const std::vector<std::string>& lines) {
    data all = list();
    for (const std::string& line : lines) {
        all << data("text", line);
    }
    return all;
}

data table_data(const Table& table) {
    data heads = list();
    for (std::size_t i = 1; i < table.heads.size(); ++i) {
        data head("text", table.heads[i].text);
        add_show(head, table.heads[i].show_s);
        heads << head;
    }
    data rows = list();
    for (const TableRow& row : table.rows) {
        data item;
        item.set("label", row.label);
        item.set("key", row.key);
        item.set("indented", row.indented);
        if (row.heading) {
            item.set("heading", data("span", fmt::format("{}", table.heads.size())));
        }
        add_show(item, row.show_s);
        data cells = list();
        for (const std::string& cell : row.cells) {
            cells << data("text", cell);
        }
        item.set("cells", cells);
        rows << item;
    }
    data all;
    all.set("first_head", table.heads.front().text);
    all.set("heads", heads);
    all.set("rows", rows);
    all.set("words", table.text);
    all.set("tight", table.tight);
    all.set("any", !table.rows.empty());
    return all;
}

data figure_data(const Figure& figure) {
    data item;
    item.set("id", figure.id);
    item.set("title", figure.title);
    item.set("note", figure.note);
    item.set("table", table_data(figure.table));
    item.set("moves", figure.moves);
    return item;
}

std::string script_json(const nlohmann::ordered_json& json) {
    const std::string text =
        json.dump(-1, ' ', true, nlohmann::ordered_json::error_handler_t::replace);
    std::string safe;
    safe.reserve(text.size());
    for (const char one : text) {
        if (one == '<') {  // "</script>" and "<!--" would end the element
            safe += "\\u003c";
        } else {
            safe += one;
        }
    }
    return safe;
}

void add_style_and_scripts(data& page, std::initializer_list<std::string_view> scripts) {
    page.set("css", file_text("page.css"));
    page.set("chart_js", file_text("chart.min.js"));
    page.set("chart_licence", file_text("chart_licence.txt"));
    std::string script;
    for (const std::string_view name : scripts) {
        script += page_file(name);
    }
    page.set("script", script);
    page.set("version", kVersion);
}

std::string rendered(std::string_view mustache_file, data& page) {
    for (const char* const partial : {"table", "figure"}) {
        page.set(std::string(partial) + "_part", data(kainjow::mustache::partial([partial] {
                     return file_text(std::string(partial) + ".mustache");
                 })));
    }
    kainjow::mustache::mustache file(file_text(mustache_file));
    std::string html = file.render(page);
    if (!file.is_valid()) {
        throw std::logic_error(std::string(mustache_file) + ": " + file.error_message());
    }
    return html;
}

}  // namespace gazeloop::report::page

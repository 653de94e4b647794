#include "drivers/trace/screen_sidecar.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>
#include <vector>

#include "drivers/trace/json_file.h"

namespace gazeloop::drivers {
namespace {

constexpr std::string_view kMissingAtZero = "x and y are 0,0";

Expected<std::optional<nlohmann::json>> find(const TraceFile& file, std::string& name) {
    TraceFile stem = file;
    if (stem.extension() == ".gz") {
        stem.replace_extension();
    }
    for (const TraceFile& candidate :
         {TraceFile{stem}.replace_extension(".json"), TraceFile{stem.string() + ".json"}}) {
        auto json = read_json_object(candidate);
        if (!json || *json) {
            name = candidate.string();
            return json;
        }
    }
    return std::optional<nlohmann::json>{};
}

}  // namespace

Expected<ScreenSidecar> read_screen_sidecar(const TraceFile& file, const std::string& name,
                                            const std::optional<glm::dvec2>& size_px) {
    const auto refuse = [&](std::string_view why) {
        return std::unexpected(
            Error{ErrorKind::BadInput,
                  fmt::format(
                      "{}: {}; pixels have no direction without {} in a JSON file beside the table",
                      name, why,
                      size_px ? "screen_size_m and view_distance_m"
                              : "screen_size_m, screen_px and view_distance_m")});
    };
    std::string sidecar_name;
    const auto json = file.empty()
                          ? Expected<std::optional<nlohmann::json>>{std::optional<nlohmann::json>{}}
                          : find(file, sidecar_name);
    if (!json) {
        return std::unexpected(json.error());
    }
    if (!*json) {
        return refuse("no geometry of the screen");
    }
    if (const std::string missing = text_in(**json, "missing");
        (**json).contains("missing") && missing != kMissingAtZero) {
        return std::unexpected(Error{
            ErrorKind::BadInput,
            fmt::format("{}: 'missing' says how losses are written, and only \"{}\" is known: "
                        "write that, or leave it out and empty the cells of losses",
                        sidecar_name, kMissingAtZero)});
    }
    const auto size_m = numbers_in<2>(**json, "screen_size_m");
    const auto written_px = numbers_in<2>(**json, "screen_px");
    const auto distance_m = number_in(**json, "view_distance_m");
    if (!size_m || (!written_px && !size_px) || !distance_m) {
        std::vector<std::string_view> lacking;
        for (const auto& [there, what] :
             {std::pair{size_m.has_value(), "screen_size_m (two numbers)"},
              std::pair{written_px || size_px, "screen_px (two numbers)"},
              std::pair{distance_m.has_value(), "view_distance_m (a number)"}}) {
            if (!there) {
                lacking.emplace_back(what);
            }
        }
        return refuse(fmt::format("{} lacks {}", sidecar_name, fmt::join(lacking, " and ")));
    }
    const ScreenSidecar sidecar{
        .screen = {.size_m = {(*size_m)[0], (*size_m)[1]},
                   .size_px = size_px ? *size_px : glm::dvec2{(*written_px)[0], (*written_px)[1]},
                   .middle_m = {0.0, 0.0, -*distance_m}},
        .zero_is_missing = text_in(**json, "missing") == kMissingAtZero};
    if (const auto right = sidecar.screen.check(); !right) {
        return std::unexpected(
            Error{ErrorKind::BadInput, fmt::format("{}: {}", sidecar_name, right.error())});
    }
    return sidecar;
}

}  // namespace gazeloop::drivers

#include "runtime/settings/settings.h"

#include <fmt/core.h>
#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdlib>
#include <initializer_list>
#include <limits>
#include <optional>
#include <sstream>
#include <type_traits>

#include "runtime/foveation/eye/stela_csf.h"
#include "runtime/foveation/log_polar/acuity_profile.h"
#include "runtime/foveation/log_polar/log_polar_map.h"
#include "runtime/foveation/plans/shading_rings.h"
#include "runtime/foveation/plans/sparse_pattern.h"
#include "runtime/open_for_reading.h"
#include "runtime/render/eye_uniforms.h"
#include "runtime/render/method.h"
#include "runtime/settings/nearest_name.h"
#include "runtime/settings/profiles.h"

namespace gazeloop::settings {
namespace {

/// A number written in full; an error says what the text is instead.
template <typename T>
std::expected<T, std::string_view> parse_number(std::string_view text) {
    T value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (end != text.data() + text.size() || error == std::errc::invalid_argument) {
        return std::unexpected(std::is_integral_v<T> ? "not a whole number" : "not a number");
    }
    if (error != std::errc{}) {
        return std::unexpected("too large or too small a number");
    }
    return value;
}

/// In the order of Settings::Written.
constexpr std::array<std::string_view, 6> kWrittenNames{
    "a bare word", "a text", "a number", "a whole number", "true or false", "a table"};

template <std::size_t N>
std::vector<std::string> names(const std::array<std::string_view, N>& views) {
    return {views.begin(), views.end()};
}

std::unexpected<Error> refuse(std::string_view origin, std::string message) {
    return std::unexpected(
        Error{ErrorKind::Usage, fmt::format("{}: {}", origin, std::move(message))});
}

/// One line of a TOML file.
struct Assignment {
    std::string key;
    std::string text;
    Settings::Written written = Settings::Written::Bare;
    toml::source_index line = 0;
};

std::optional<Assignment> assignment(std::string key, const toml::node& node) {
    using Written = Settings::Written;
    const toml::source_index line = node.source().begin.line;
    if (const auto text = node.value_exact<std::string>()) {
        return Assignment{std::move(key), *text, Written::Text, line};
    }
    if (const auto whole = node.value_exact<std::int64_t>()) {
        return Assignment{std::move(key), fmt::format("{}", *whole), Written::Whole, line};
    }
    if (const auto number = node.value_exact<double>()) {
        return Assignment{std::move(key), fmt::format("{}", *number), Written::Number, line};
    }
    if (const auto flag = node.value_exact<bool>()) {
        return Assignment{std::move(key), *flag ? "true" : "false", Written::Flag, line};
    }
    if (const toml::array* const list = node.as_array(); list && key == "kfr.polynomial") {
        std::string text;
        for (const toml::node& each : *list) {
            const auto number = each.value<double>();
            if (!number) {
                return std::nullopt;
            }
            text += fmt::format("{}{}", text.empty() ? "" : ",", *number);
        }
        return Assignment{std::move(key), text, Written::Text, line};
    }
    return std::nullopt;
}

/// A table's lines with their full keys. A table without any is a line of its own, so that a
/// misspelt one is noticed.
Expected<void> flatten(const toml::table& table, const std::string& prefix, const std::string& file,
                       std::vector<Assignment>& lines) {
    for (const auto& [name, node] : table) {
        const std::string key = prefix + std::string(name.str());
        if (const toml::table* const inner = node.as_table()) {
            if (inner->empty()) {
                lines.push_back({key, "", Settings::Written::Group, node.source().begin.line});
            } else if (auto flat = flatten(*inner, key + ".", file, lines); !flat) {
                return flat;
            }
            continue;
        }
        auto line = assignment(key, node);
        if (!line) {
            return refuse(fmt::format("{}:{}", file, node.source().begin.line),
                          fmt::format("{}: one value is expected", key));
        }
        lines.push_back(std::move(*line));
    }
    return {};
}

/// As TOML writes it.
std::string quoted(const std::string& text) {
    std::ostringstream out;
    out << toml::value(text);
    return out.str();
}

}  // namespace

Settings::Settings() {
    using foveation::AcuityParameters;
    using foveation::KfrParameters;
    using foveation::PowerKernel;
    using foveation::SparseParameters;
    SettingValues& v = values_;
    const double forever_ms = 1e7;
    entries_ = {
        {"acuity.border_px", "width of the blend between disc and LP-buffer, at the gaze",
         Number{&v.acuity.border_px, 0.0, 64.0}},
        {"acuity.disc", "shade pixels directly where the display is the limit", &v.acuity.disc},
        {"acuity.lp_height", "rows of the LP-buffer; 0: as many as the eye asks for",
         Whole{&v.acuity.lp_height, 0, foveation::LpSize::kMaxSide}},
        {"acuity.lp_width", "columns of the LP-buffer; 0: as many as the eye asks for",
         Whole{&v.acuity.lp_width, 0, foveation::LpSize::kMaxSide}},
        {"acuity.luminance_cd_m2", "what stelaCSF takes the picture's luminance to be",
         Number{&v.acuity.luminance_cd_m2, foveation::StelaConditions::kMinLuminance,
                foveation::StelaConditions::kMaxLuminance}},
        {"acuity.mar", "slope m of the line of the least resolvable angle, m e + 1/48",
         Number{&v.acuity.mar, foveation::MarLine::kMinSlope, foveation::MarLine::kMaxSlope}},
        {"acuity.nasal", "stelaCSF: sharper towards the nose; else the other side all around",
         &v.acuity.nasal},
        {"acuity.pixels_per_degree", "what the map takes the display for; 0: the most in view",
         Number{&v.acuity.pixels_per_degree, 0.0, AcuityParameters::kMaxPixelsPerDegree}},
        {"gaze.fixation_distance_m",
         "distance at which gaze is held in world, and where one ray for both eyes is split, m",
         Number{&v.gaze.fixation_distance_m, 0.1, 1000.0}},
        {"gaze.fixation_from_depth",
         "split one ray for both eyes where the last frame's depth says, if it does",
         &v.gaze.fixation_from_depth},
        {"gaze.hold_ms", "lost gaze: hold the last point for this long",
         Number{&v.gaze.hold_ms, 0.0, forever_ms}},
        {"gaze.minimum_confidence", "samples that state less are invalid",
         Number{&v.gaze.minimum_confidence, 0.0, 1.0}},
        {"gaze.return_ms", "lost gaze: then return to straight ahead in this time",
         Number{&v.gaze.return_ms, 0.0, forever_ms}},
        {"gaze.stale_ms", "samples older than this at the latch count as lost",
         Number{&v.gaze.stale_ms, 0.0, forever_ms}},
        {"hid.eye_distance_m", "HID tracker: between the eyes, where it does not see both, m",
         Number{&v.hid.eye_distance_m, 0.0, 0.2}},
        {"hid.screen_height_m", "HID tracker: height of its screen, m; 0: as it states",
         Number{&v.hid.screen_height_m, 0.0, 100.0}},
        {"hid.screen_width_m", "HID tracker: width of its screen, m; 0: as it states",
         Number{&v.hid.screen_width_m, 0.0, 100.0}},
        {"hid.viewing_distance_m",
         "HID tracker: from eyes to screen, where it does not see them, m; 0: unknown",
         Number{&v.hid.viewing_distance_m, 0.0, 100.0}},
        {"kfr.alpha", "of the kernels power, x^alpha, and power-as-printed",
         Number{&v.kfr.alpha, PowerKernel::kMinAlpha, PowerKernel::kMaxAlpha}},
        {"kfr.border_px", "width of the blend between disc and LP-buffer",
         Number{&v.kfr.border_px, 0.0, 64.0}},
        {"kfr.close_hole", "without the disc: still shade the kernel's hole directly",
         &v.kfr.close_hole},
        {"kfr.disc", "shade pixels directly where a texel a pixel is offered", &v.kfr.disc},
        {"kfr.kernel", "how columns spread from the fovea",
         Choice{&v.kfr.kernel, names(foveation::kKernelNames)}},
        {"kfr.kernel_samples", "of the kernel table: x,y;x,y;... from 0,0 to 1,1",
         Choice{&v.kfr.kernel_samples, {}}},
        {"kfr.kernel_table", "of the kernel table: a .csv or .toml file to take its samples from",
         Path{&v.kfr.kernel_table, ""}},
        {"kfr.lp_height", "rows of the LP-buffer; 0: the picture's over sigma",
         Whole{&v.kfr.lp_height, 0, foveation::LpSize::kMaxSide}},
        {"kfr.lp_width", "columns of the LP-buffer; 0: the picture's over sigma",
         Whole{&v.kfr.lp_width, 0, foveation::LpSize::kMaxSide}},
        {"kfr.polynomial", "of the kernel polynomial: coefficients of x, x^2, ...; sum 1",
         Choice{&v.kfr.polynomial, {}}},
        {"kfr.sigma", "picture width over LP-buffer width",
         Number{&v.kfr.sigma, KfrParameters::kMinSigma, KfrParameters::kMaxSigma}},
        {"layers.n", "eccentricity layers, at most", Whole{&v.layers.n, 2, 4}},
        {"layers.outer_weight", "work of the outer layers' samples: 0.5 at half rate",
         Number{&v.layers.outer_weight, 0.05, 1.0}},
        {"layers.s2_fixed", "middle layer at 2x2 pixels, as published (layers.n over 2)",
         &v.layers.s2_fixed},
        {"profile.display", "display profile, or a .toml file", Path{&v.profile.display, ".toml"}},
        {"profile.tracker", "tracker profile, or a .toml file", Path{&v.profile.tracker, ".toml"}},
        {"render.depth", "hand depth images to the runtime, where it takes them", &v.render.depth},
        {"render.frames_in_flight", "frames that the GPU may be working on",
         Whole{&v.render.frames_in_flight, 1, 3}},
        {"render.hidden_area", "leave out what the headset shows to no eye", &v.render.hidden_area},
        {"render.method", "which samples a picture takes",
         Choice{&v.render.method, names(render::kMethodNames)}},
        {"render.profile", "time every pass apart, a submit each", &v.render.profile},
        {"render.scale", "picture size over the display's", Number{&v.render.scale, 0.01, 2.0}},
        {"render.scene", "what is rendered", Choice{&v.render.scene, names(render::kSceneNames)}},
        {"render.spp", "samples a texel or pixel", Whole{&v.render.spp, 1, render::kMaxSamples}},
        {"rings.inner_deg", "a sample a pixel within; both 0: as acuity.mar asks",
         Number{&v.rings.inner_deg, 0.0, 180.0}},
        {"rings.outer_deg", "2x2 pixels a sample within, 4x4 beyond",
         Number{&v.rings.outer_deg, 0.0, 180.0}},
        {"rings.tile_px", "side of the tiles that have one rate",
         Whole{&v.rings.tile_px, foveation::RingParameters::kMinTilePx,
               foveation::RingParameters::kMaxTilePx}},
        {"sim.seed", "the same seed gives the same simulated gaze", Seed{&v.sim.seed}},
        {"sparse.disc_share", "of the samples that the full disc takes",
         Number{&v.sparse.disc_share, 0.0, 0.9}},
        {"sparse.narrow_share", "of the draws that are from the narrow Gaussian",
         Number{&v.sparse.narrow_share, 0.0, 1.0}},
        {"sparse.narrow_spread", "its standard deviation over the picture's diagonal",
         Number{&v.sparse.narrow_spread, SparseParameters::kMinSpread,
                SparseParameters::kMaxSpread}},
        {"sparse.placement", "how samples are placed",
         Choice{&v.sparse.placement, {"gaussian", "blue_noise"}}},
        {"sparse.share", "samples over pixels, gaze at the centre",
         Number{&v.sparse.share, SparseParameters::kMinShare, SparseParameters::kMaxShare}},
        {"sparse.wide_spread", "standard deviation of the wide Gaussian over the diagonal",
         Number{&v.sparse.wide_spread, SparseParameters::kMinSpread, SparseParameters::kMaxSpread}},
        {"target.name", "where pictures go", Choice{&v.target.name, {"openxr", "headless"}}},
        {"target.validation", "OpenXR core validation layer", &v.target.validation},
        {"virtual_time.gpu_ms", "modelled time on the GPU of a frame in virtual time",
         Number{&v.virtual_time.gpu_ms, 0.0, 1000.0}},
        {"vulkan.device", "part of the Vulkan device's name (headless)",
         Choice{&v.vulkan.device, {}}},
        {"vulkan.validation", "Khronos validation layer, with synchronization",
         &v.vulkan.validation},
    };
    for (const sim::Term& term : sim::terms_of(v.sim)) {
        entries_.push_back({fmt::format("sim.{}", term.key), std::string(term.meaning),
                            Number{term.value, term.least, term.greatest}});
    }
    std::ranges::sort(entries_, {}, &Entry::key);
}

std::vector<std::string> Settings::keys() const {
    std::vector<std::string> keys;
    keys.reserve(entries_.size());
    for (const Entry& entry : entries_) {
        keys.push_back(entry.key);
    }
    return keys;
}

Expected<void> Settings::set(std::string_view key, std::string_view text, std::string_view origin) {
    return assign(key, text, Written::Bare, origin, "");
}

Expected<void> Settings::assign(std::string_view key, std::string_view text, Written written,
                                std::string_view origin, const std::filesystem::path& folder) {
    const auto entry = std::ranges::find(entries_, key, &Entry::key);
    if (entry == entries_.end()) {
        const bool group =
            written == Written::Group && std::ranges::any_of(entries_, [&](const Entry& one) {
                return one.key.starts_with(std::string(key) + ".");
            });
        return group ? Expected<void>{} : refuse(origin, unknown_key(key, keys()));
    }
    const auto wrong_kind = [&](std::string_view wanted) {
        return refuse(origin, fmt::format("{}: {} is expected, this is {}", key, wanted,
                                          kWrittenNames[static_cast<std::size_t>(written)]));
    };
    const auto out_of_range = [&](auto least, auto greatest) {
        return refuse(origin,
                      fmt::format("{} = {}: must lie in [{}, {}]", key, text, least, greatest));
    };
    const auto malformed = [&](std::string_view why) {
        return refuse(origin, fmt::format("{} = '{}': {}", key, text, why));
    };
    const auto is = [&](std::initializer_list<Written> kinds) {
        return written == Written::Bare || std::ranges::find(kinds, written) != kinds.end();
    };
    if (Number* const number = std::get_if<Number>(&entry->slot)) {
        if (!is({Written::Number, Written::Whole})) {
            return wrong_kind("a number");
        }
        const auto value = parse_number<double>(text);
        if (!value) {
            return malformed(value.error());
        }
        if (!(*value >= number->least && *value <= number->greatest)) {
            return out_of_range(number->least, number->greatest);
        }
        *number->value = *value;
    } else if (Whole* const whole = std::get_if<Whole>(&entry->slot)) {
        if (!is({Written::Whole})) {
            return wrong_kind("a whole number");
        }
        const auto value = parse_number<std::int64_t>(text);
        if (!value) {
            return malformed(value.error());
        }
        if (*value < whole->least || *value > whole->greatest) {
            return out_of_range(whole->least, whole->greatest);
        }
        *whole->value = *value;
    } else if (bool** const flag = std::get_if<bool*>(&entry->slot)) {
        if (!is({Written::Flag})) {
            return wrong_kind("true or false");
        }
        if (text != "true" && text != "false") {
            return malformed("must be true or false");
        }
        **flag = text == "true";
    } else if (Seed* const seed = std::get_if<Seed>(&entry->slot)) {
        const auto value = parse_number<std::uint64_t>(text);
        if (!value) {
            return refuse(origin, fmt::format("{} = '{}': not a whole number from 0 to {}", key,
                                              text, std::numeric_limits<std::uint64_t>::max()));
        }
        *seed->value = *value;
    } else if (!is({Written::Text})) {
        return wrong_kind("a text in quotes");
    } else if (Path* const path = std::get_if<Path>(&entry->slot)) {
        *path->value = path->is_file(text) ? (folder / text).string() : std::string(text);
    } else {
        Choice& choice = std::get<Choice>(entry->slot);
        if (!choice.names.empty() && std::ranges::find(choice.names, text) == choice.names.end()) {
            const std::string_view what = key.substr(key.find('.') + 1);
            return refuse(origin,
                          unknown_name(what == "name" ? "target" : what, text, choice.names));
        }
        *choice.value = text;
    }
    entry->origin = origin;
    return {};
}

Expected<void> Settings::set_default(std::string_view key, std::string_view text,
                                     std::string_view origin) {
    const auto entry = std::ranges::find(entries_, key, &Entry::key);
    if (entry != entries_.end() && entry->origin != kBuiltIn) {
        return {};
    }
    return set(key, text, origin);
}

Expected<void> Settings::load(const std::filesystem::path& file) {
    const std::string name = file.string();
    auto in = open_for_reading(file);
    if (!in) {
        return std::unexpected(
            Error{ErrorKind::BadInput,
                  fmt::format("{}: the configuration cannot be read ({})", name, in.error())});
    }
    std::vector<Assignment> lines;
    try {
        if (auto flat = flatten(toml::parse(*in, name), "", name, lines); !flat) {
            return flat;
        }
    } catch (const toml::parse_error& error) {
        return std::unexpected(
            Error{ErrorKind::BadInput,
                  fmt::format("{}:{}: {}", name, error.source().begin.line, error.description())});
    }
    // The first of several errors is the one that stands first.
    std::ranges::stable_sort(lines, {}, &Assignment::line);
    for (const Assignment& line : lines) {
        if (auto set = assign(line.key, line.text, line.written,
                              fmt::format("{}:{}", name, line.line), file.parent_path());
            !set) {
            return set;
        }
    }
    return {};
}

std::vector<std::filesystem::path> Settings::standard_files() {
    std::vector<std::filesystem::path> folders{"/etc"};
    const char* const config = std::getenv("XDG_CONFIG_HOME");
    // The base directory specification: a relative path there counts as none.
    if (config != nullptr && std::filesystem::path(config).is_absolute()) {
        folders.emplace_back(config);
    } else if (const char* const home = std::getenv("HOME"); home != nullptr && *home != '\0') {
        folders.push_back(std::filesystem::path(home) / ".config");
    }
    for (std::filesystem::path& folder : folders) {
        folder /= "gazeloop/config.toml";
    }
    return folders;
}

bool Settings::is_there(const std::filesystem::path& file) {
    // What may not be looked at, or points nowhere, is there: reading it then says what is wrong.
    std::error_code failure;
    return std::filesystem::symlink_status(file, failure).type() !=
           std::filesystem::file_type::not_found;
}

Expected<void> Settings::load_standard_files() {
    for (const std::filesystem::path& file : standard_files()) {
        if (is_there(file)) {
            if (auto loaded = load(file); !loaded) {
                return loaded;
            }
        }
    }
    return {};
}

std::string Settings::text(const Entry& entry) {
    if (const auto* const number = std::get_if<Number>(&entry.slot)) {
        return fmt::format("{}", *number->value);
    }
    if (const auto* const whole = std::get_if<Whole>(&entry.slot)) {
        return fmt::format("{}", *whole->value);
    }
    if (const auto* const seed = std::get_if<Seed>(&entry.slot)) {
        return fmt::format("{}", *seed->value);
    }
    if (bool* const* const flag = std::get_if<bool*>(&entry.slot)) {
        return **flag ? "true" : "false";
    }
    if (const auto* const path = std::get_if<Path>(&entry.slot)) {
        // In full, since what is printed or recorded may be read elsewhere.
        std::error_code no_current_folder;
        const std::filesystem::path full =
            path->is_file(*path->value) ? std::filesystem::absolute(*path->value, no_current_folder)
                                        : std::filesystem::path();
        return full.empty() ? *path->value : full.string();
    }
    return *std::get<Choice>(entry.slot).value;
}

const Settings::Entry& Settings::entry(std::string_view key) const {
    return *std::ranges::find(entries_, key, &Entry::key);
}

const std::string& Settings::origin(std::string_view key) const { return entry(key).origin; }

Error Settings::at_origin(std::string_view key, const Error& error) const {
    const Entry& at = entry(key);
    return at.origin == kBuiltIn
               ? error
               : Error{error.kind, fmt::format("{}: {}: {}", at.origin, key, error.message)};
}

std::string Settings::with_origin(std::string_view key) const {
    const Entry& at = entry(key);
    return fmt::format("{} = {} ({})", key, text(at), at.origin);
}

Expected<void> Settings::check() const {
    if (is_built_in("kfr.kernel")) {
        // Nobody has chosen the kernel that these are for.
        for (const auto& [key, kernel] :
             {std::pair{"kfr.kernel_table", "table"}, std::pair{"kfr.kernel_samples", "table"},
              std::pair{"kfr.polynomial", "polynomial"}}) {
            if (!is_built_in(key)) {
                return refuse(with_origin(key),
                              fmt::format("has no effect while {}: set kfr.kernel={} too",
                                          with_origin("kfr.kernel"), kernel));
            }
        }
    }
    // Gaze that stops coming counts as lost only when it is stale: past its hold time by then, the
    // fovea would begin its return in the middle.
    if (values_.gaze.hold_ms < values_.gaze.stale_ms) {
        return refuse(
            with_origin("gaze.hold_ms"),
            fmt::format("is less than {}: the fovea would jump when gaze stops coming; "
                        "set gaze.hold_ms to {} or more, or gaze.stale_ms to {} or less",
                        with_origin("gaze.stale_ms"), values_.gaze.stale_ms, values_.gaze.hold_ms));
    }
    return {};
}

std::vector<NamedValue> Settings::list() const {
    std::vector<NamedValue> values;
    values.reserve(entries_.size());
    for (const Entry& entry : entries_) {
        values.push_back({entry.key, text(entry)});
    }
    return values;
}

std::string Settings::describe() const {
    std::string table;
    for (const Entry& entry : entries_) {
        // A seed may be above what TOML's numbers hold.
        const bool is_text = std::holds_alternative<Choice>(entry.slot) ||
                             std::holds_alternative<Path>(entry.slot) ||
                             std::holds_alternative<Seed>(entry.slot);
        table +=
            fmt::format("{:28} = {:12} # {:9} {}\n", entry.key,
                        is_text ? quoted(text(entry)) : text(entry), entry.origin, entry.meaning);
    }
    return table;
}

}  // namespace gazeloop::settings

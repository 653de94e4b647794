#include "runtime/scene/light_field_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <toml++/toml.h>
#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <deque>
#include <fstream>
#include <future>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <span>
#include <thread>
#include <utility>

#include "runtime/open_for_reading.h"
#include "runtime/scene/gltf/picture.h"

namespace gazeloop::scene {
namespace {

constexpr double kRadiansPerHalfDegree = std::numbers::pi / 360.0;
constexpr std::size_t kLongestFile = 1 << 16;
/// Longer lists help nobody.
constexpr std::size_t kMostListed = 12;

std::unexpected<Error> refuse(const std::string& what) {
    return std::unexpected(Error{ErrorKind::BadInput, what});
}

/// All that is wrong with a folder.
class Problems {
  public:
    void add(std::string problem) { all_.push_back(std::move(problem)); }
    void add(const Problems& others) {
        all_.insert(all_.end(), others.all_.begin(), others.all_.end());
    }
    [[nodiscard]] bool any() const { return !all_.empty(); }
    [[nodiscard]] Error error(const std::filesystem::path& file) const {
        const auto listed = std::span(all_).first(std::min(all_.size(), kMostListed));
        return {ErrorKind::BadInput,
                fmt::format("{}: its pictures cannot be used: {}{}", file.string(),
                            fmt::join(listed, "; "),
                            all_.size() > kMostListed
                                ? fmt::format("; and {} more", all_.size() - kMostListed)
                                : "")};
    }

  private:
    std::vector<std::string> all_;
};

struct Place {
    std::uint32_t row = 0;
    std::uint32_t column = 0;
    friend auto operator<=>(const Place&, const Place&) = default;
};

/// Takes the number that a text ends in off it.
std::optional<std::uint32_t> take_number(std::string_view& text) {
    std::size_t digits = 0;
    while (digits < text.size() &&
           std::isdigit(static_cast<unsigned char>(text[text.size() - 1 - digits])) != 0) {
        ++digits;
    }
    const std::string_view number = text.substr(text.size() - digits);
    std::uint32_t value = 0;
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), value);
    if (digits == 0 || error != std::errc{} || end != number.data() + number.size()) {
        return std::nullopt;
    }
    text.remove_suffix(digits);
    return value;
}

std::optional<Place> place_of(std::string_view stem) {
    const auto column = take_number(stem);
    if (!column || stem.empty() || (stem.back() != '_' && stem.back() != '-')) {
        return std::nullopt;
    }
    stem.remove_suffix(1);
    const auto row = take_number(stem);
    return row ? std::optional(Place{*row, *column}) : std::nullopt;
}

bool is_picture(const std::filesystem::path& file) {
    std::string extension = file.extension().string();
    std::ranges::transform(extension, extension.begin(), [](char c) {
        return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    });
    return extension == ".png" || extension == ".jpg" || extension == ".jpeg";
}

/// The pictures of the folder by their places.
std::map<Place, std::filesystem::path> find_views(const std::filesystem::path& folder,
                                                  const light_field::CameraGrid& grid,
                                                  Problems& problems) {
    std::set<std::filesystem::path> files;
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
        if (is_picture(entry.path())) {
            files.insert(entry.path());
        }
    }
    std::map<Place, std::filesystem::path> views;
    for (const std::filesystem::path& file : files) {
        const std::string name = file.filename().string();
        const auto place = place_of(file.stem().string());
        if (!place) {
            problems.add(name + " does not end in row and column (view_03_07.png)");
        } else if (place->row >= grid.rows || place->column >= grid.columns) {
            problems.add(fmt::format("{} is beyond the {} rows and {} columns", name, grid.rows,
                                     grid.columns));
        } else if (const auto [at, is_new] = views.try_emplace(*place, file); !is_new) {
            problems.add(
                fmt::format("{} and {} are of one place", at->second.filename().string(), name));
        }
    }
    for (std::uint32_t row = 0; row < grid.rows; ++row) {
        for (std::uint32_t column = 0; column < grid.columns; ++column) {
            if (!views.contains({row, column})) {
                problems.add(view_file_name(row, column) + " is missing");
            }
        }
    }
    return views;
}

std::vector<std::byte> bytes_of(const std::filesystem::path& file) {
    auto in = open_regular_file(file);
    if (!in) {
        throw gltf::Refusal("", "it cannot be read (" + in.error() + ")");
    }
    std::vector<std::byte> bytes(std::filesystem::file_size(file));
    in->read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    bytes.resize(static_cast<std::size_t>(in->gcount()));
    return bytes;
}

using Views = std::map<Place, std::filesystem::path>;

/// The size of the first view that has one; else all views are problems.
struct Size {
    std::uint32_t width_px = 0;
    std::uint32_t height_px = 0;
};
Size size_of(const Views& views, Problems& problems) {
    Problems of_all;
    for (const auto& [place, view] : views) {
        try {
            const gltf::PictureHeader header = gltf::read_picture_header(bytes_of(view), "", {});
            return {header.width, header.height};
        } catch (const gltf::Refusal& refusal) {
            of_all.add(fmt::format("{}: {}", view.filename().string(), refusal.what()));
        }
    }
    problems.add(of_all);
    return {};
}

/// Decodes one view. Throws gltf::Refusal.
LightFieldSource::Texels decode(const std::filesystem::path& file, const Size& expected) {
    const std::vector<std::byte> bytes = bytes_of(file);
    const gltf::PictureHeader header = gltf::read_picture_header(bytes, "", {});
    if (header.width != expected.width_px || header.height != expected.height_px) {
        gltf::refuse("", fmt::format("it has {}x{} px, those before it {}x{}", header.width,
                                     header.height, expected.width_px, expected.height_px));
    }
    if (header.format != mesh::TexelFormat::Rgba8) {
        gltf::refuse("", "it has 16 bits per channel: 8 are expected");
    }
    mesh::Image image;
    gltf::Notes notes;
    gltf::decode_picture(bytes, header, "", image, notes);
    if (!notes.all().empty()) {
        gltf::refuse("", notes.all().front().text);
    }
    return std::move(image.texels);
}

/// Decodes as many views at once as there are processors. After the first one that is damaged, and
/// where there are problems already, they are only looked at.
Expected<void> read_views(const Views& views, const Size& size,
                          const LightFieldSource::Prepare& prepare,
                          const LightFieldSource::Take& take, Problems& problems) {
    const std::size_t at_once = std::max(1U, std::thread::hardware_concurrency());
    std::deque<std::pair<std::string, std::future<LightFieldSource::Texels>>> under_way;
    std::uint32_t taken = 0;
    const auto take_first = [&]() -> Expected<void> {
        auto [name, texels] = std::move(under_way.front());
        under_way.pop_front();
        try {
            const LightFieldSource::Texels prepared = texels.get();
            if (problems.any()) {
                return {};
            }
            return take(taken++, prepared);
        } catch (const gltf::Refusal& refusal) {
            problems.add(fmt::format("{}: {}", name, refusal.what()));
            return {};
        }
    };
    for (const auto& [place, view] : views) {
        under_way.emplace_back(view.filename().string(),
                               std::async(std::launch::async, [&, at = view] {
                                   LightFieldSource::Texels texels = decode(at, size);
                                   if (prepare) {
                                       texels = prepare(std::move(texels));
                                   }
                                   return texels;
                               }));
        if (under_way.size() >= at_once) {
            if (auto done = take_first(); !done) {
                return done;
            }
        }
    }
    while (!under_way.empty()) {
        if (auto done = take_first(); !done) {
            return done;
        }
    }
    return {};
}

}  // namespace

bool is_light_field_file(std::string_view name) {
    return name.size() > kLightFieldExtension.size() && name.ends_with(kLightFieldExtension);
}

Expected<light_field::CameraGrid> read_light_field(std::istream& in, const std::string& name) {
    std::string text(kLongestFile + 1, '\0');
    in.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(in.gcount()));
    if (text.size() > kLongestFile) {
        return refuse(name + ": a light field's file has at most 64 KiB");
    }
    light_field::CameraGrid grid;
    double columns = 0.0;
    double rows = 0.0;
    double horizontal_deg = 0.0;
    double vertical_deg = 0.0;
    const std::array keys{std::pair{"columns", &columns}, std::pair{"rows", &rows},
                          std::pair{"spacing_m", &grid.spacing_m},
                          std::pair{"horizontal_deg", &horizontal_deg},
                          std::pair{"vertical_deg", &vertical_deg}};
    try {
        const toml::table table = toml::parse(text, name);
        for (const auto& [key, node] : table) {
            if (std::ranges::none_of(keys,
                                     [&](const auto& known) { return key.str() == known.first; })) {
                return refuse(fmt::format("{}:{}: there is no key '{}' in a light field's file",
                                          name, node.source().begin.line, key.str()));
            }
        }
        for (const auto& [key, value] : keys) {
            const auto number = table[key].value<double>();
            if (!number) {
                return refuse(fmt::format("{}: {} = NUMBER is expected", name, key));
            }
            *value = *number;
        }
    } catch (const toml::parse_error& error) {
        return refuse(
            fmt::format("{}:{}: {}", name, error.source().begin.line, error.description()));
    }
    const auto whole = [](double value) {
        return value >= 0.0 && value <= 1e6 && value == std::floor(value);
    };
    if (!whole(columns) || !whole(rows)) {
        return refuse(name + ": columns and rows are whole numbers");
    }
    grid.columns = static_cast<std::uint32_t>(columns);
    grid.rows = static_cast<std::uint32_t>(rows);
    grid.half_tangents = {std::tan(horizontal_deg * kRadiansPerHalfDegree),
                          std::tan(vertical_deg * kRadiansPerHalfDegree)};
    const auto field_ok = [](double deg) { return deg > 0.0 && deg < 180.0; };
    if (!field_ok(horizontal_deg) || !field_ok(vertical_deg)) {
        return refuse(name + ": a field of view must lie between 0 and 180 deg");
    }
    if (const auto good = check(grid); !good) {
        return refuse(fmt::format("{}: {}", name, good.error().message));
    }
    return grid;
}

std::string light_field_text(const light_field::CameraGrid& grid) {
    const auto degrees = [](double tangent) { return std::atan(tangent) / kRadiansPerHalfDegree; };
    return fmt::format(
        "# The views beside this file, by row (0 is the top one) and column (0 is the leftmost).\n"
        "columns = {}\n"
        "rows = {}\n"
        "spacing_m = {}        # between neighbouring cameras\n"
        "horizontal_deg = {}   # field of view of each\n"
        "vertical_deg = {}\n",
        grid.columns, grid.rows, grid.spacing_m, degrees(grid.half_tangents.x),
        degrees(grid.half_tangents.y));
}

std::string view_file_name(std::uint32_t row, std::uint32_t column) {
    return fmt::format("view_{:02}_{:02}.png", row, column);
}

Expected<LightFieldSource> open_light_field(const std::filesystem::path& file) {
    auto in = open_regular_file(file);
    if (!in) {
        return refuse(
            fmt::format("{}: the light field cannot be read ({})", file.string(), in.error()));
    }
    const auto grid = read_light_field(*in, file.string());
    if (!grid) {
        return std::unexpected(grid.error());
    }
    Problems problems;
    const auto views =
        find_views(file.parent_path().empty() ? "." : file.parent_path(), *grid, problems);
    const bool complete = !problems.any();
    const Size size = size_of(views, problems);
    if (size.width_px > 0 && !complete) {
        // It is refused anyway, so that this costs no second decoding: with what else is wrong.
        if (auto looked = read_views(views, size, {}, {}, problems); !looked) {
            return std::unexpected(looked.error());
        }
    }
    if (size.width_px == 0 || !complete) {
        return std::unexpected(problems.error(file));
    }
    return LightFieldSource{.name = file.string(),
                            .cameras = *grid,
                            .width_px = size.width_px,
                            .height_px = size.height_px,
                            .read = [file, views, size](const LightFieldSource::Prepare& prepare,
                                                        const LightFieldSource::Take& take) {
                                Problems damaged;
                                auto read = read_views(views, size, prepare, take, damaged);
                                return damaged.any() ? std::unexpected(damaged.error(file)) : read;
                            }};
}

}  // namespace gazeloop::scene

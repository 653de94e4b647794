#include "runtime/methods/kernel_table_file.h"

#include <fmt/core.h>
#include <toml++/toml.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <sstream>
#include <string_view>
#include <vector>

#include "runtime/open_for_reading.h"

namespace gazeloop::methods {
namespace {

using Sample = foveation::TableKernel::Sample;

struct Samples {
    std::vector<Sample> samples;
    std::vector<std::size_t> lines;  ///< where each sample stands
};

std::unexpected<Error> refuse(const std::string& name, std::size_t line, std::string_view what) {
    return std::unexpected(Error{ErrorKind::BadInput, fmt::format("{}:{}: {}", name, line, what)});
}

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view kBlank = " \t\r";
    const std::size_t first = text.find_first_not_of(kBlank);
    if (first == std::string_view::npos) {
        return {};
    }
    return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

std::optional<double> number(std::string_view text) {
    text = trimmed(text);
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) {
        return std::nullopt;
    }
    return value;
}

Expected<Samples> read_csv(std::istream& in, const std::string& name) {
    Samples read;
    std::string line;
    bool first = true;
    for (std::size_t n = 1; std::getline(in, line); ++n) {
        const std::string_view text = trimmed(line);
        if (text.empty() || text.front() == '#') {
            continue;
        }
        const std::size_t comma = text.find(',');
        const bool pair = comma != std::string_view::npos;
        const auto x = number(text.substr(0, comma));
        const auto y = pair ? number(text.substr(comma + 1)) : std::nullopt;
        const bool names = first && pair && !x && !y;
        first = false;
        if (names) {
            continue;
        }
        if (!x || !y) {
            return refuse(name, n, fmt::format("'{}': two numbers x,y are expected", text));
        }
        read.samples.push_back({*x, *y});
        read.lines.push_back(n);
    }
    return read;
}

Expected<Samples> read_toml(std::istream& in, const std::string& name) {
    Samples read;
    try {
        const toml::table table = toml::parse(in, name);
        const toml::array* const pairs = table["kernel"].as_array();
        if (pairs == nullptr) {
            return refuse(name, 1, "an array kernel = [[0, 0], ..., [1, 1]] is expected");
        }
        for (const toml::node& node : *pairs) {
            const std::size_t line = node.source().begin.line;
            const toml::array* const pair = node.as_array();
            const auto at = [&](std::size_t i) { return (*pair)[i].value<double>(); };
            if (pair == nullptr || pair->size() != 2 || !at(0) || !at(1)) {
                return refuse(name, line, "a pair of numbers [x, y] is expected");
            }
            read.samples.push_back({*at(0), *at(1)});
            read.lines.push_back(line);
        }
    } catch (const toml::parse_error& error) {
        return refuse(name, error.source().begin.line, error.description());
    }
    return read;
}

}  // namespace

Expected<foveation::TableKernel> read_kernel_table(std::istream& in, const std::string& name,
                                                   bool toml) {
    const Expected<Samples> read = toml ? read_toml(in, name) : read_csv(in, name);
    if (!read) {
        return std::unexpected(read.error());
    }
    auto kernel = foveation::TableKernel::create(read->samples);
    if (!kernel) {
        const std::size_t sample = kernel.error().sample;
        return refuse(name, read->lines.empty() ? 1 : read->lines[sample], kernel.error().message);
    }
    return std::move(*kernel);
}

std::string kernel_samples(const foveation::TableKernel& kernel) {
    std::string line;
    for (std::size_t i = 0; i < kernel.samples(); ++i) {
        const Sample at = kernel.sample(i);
        line += fmt::format("{}{},{}", i == 0 ? "" : ";", at.x, at.y);
    }
    return line;
}

Expected<foveation::TableKernel> read_kernel_samples(std::string_view samples,
                                                     const std::string& name) {
    std::string lines(samples);
    std::ranges::replace(lines, ';', '\n');
    std::istringstream in(lines);
    return read_kernel_table(in, name, false);
}

Expected<foveation::TableKernel> load_kernel_table(const std::filesystem::path& file) {
    auto in = open_for_reading(file);
    if (!in) {
        return std::unexpected(Error{
            ErrorKind::BadInput,
            fmt::format("{}: the kernel's table cannot be read ({})", file.string(), in.error())});
    }
    // Far more than the samples of a table take; some files never end.
    constexpr std::size_t kLongestFile = 1 << 20;
    std::string text(kLongestFile + 1, '\0');
    in->read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(in->gcount()));
    if (text.size() > kLongestFile) {
        return std::unexpected(
            Error{ErrorKind::BadInput,
                  fmt::format("{}: a table of a kernel has at most 1 MiB", file.string())});
    }
    std::istringstream lines(text);
    return read_kernel_table(lines, file.string(), file.extension() == ".toml");
}

}  // namespace gazeloop::methods

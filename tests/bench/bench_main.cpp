#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>

#include "runtime/command_line/command_line.h"
#include "tests/bench/bench.h"

namespace gazeloop::bench {
namespace {

int code(cli::ExitCode exit_code) { return static_cast<int>(exit_code); }

struct Named {
    std::string_view name;
    std::vector<Figure> (*run)(const Options&);
};
constexpr std::array kBenches{Named{"kfr-raycast", kfr_raycast},
                              Named{"kfr-mesh", kfr_mesh},
                              Named{"latch", latch},
                              Named{"stability", stability},
                              Named{"figures", paper_figures},
                              Named{"acuity", acuity},
                              Named{"loop", loop},
                              Named{"maps", maps},
                              Named{"devices", devices},
                              Named{"report", report},
                              Named{"monitor", monitor},
                              Named{"quality", quality},
                              Named{"gltf", gltf},
                              Named{"events", events},
                              Named{"prediction", prediction},
                              Named{"rivals", rivals},
                              Named{"headline", headline},
                              Named{"front", front},
                              Named{"layer", layer},
                              Named{"layers", layers},
                              Named{"sparse", sparse},
                              Named{"lightfield", lightfield},
                              Named{"traces", traces},
                              Named{"misses", misses}};

/// Preload libraries count from a program's start: it begins once more, under umockdev's.
void begin_under_umockdev(char** arguments) {
    constexpr const char* kLibrary = "libumockdev-preload.so.0";
    const char* const preload = std::getenv("LD_PRELOAD");
    if (preload == nullptr || std::string_view(preload).find(kLibrary) == std::string_view::npos) {
        setenv("LD_PRELOAD", kLibrary, 1);
        execv("/proc/self/exe", arguments);
    }
}

void print(const std::vector<Figure>& figures) {
    fmt::print("{:12} {:18} {:28} {:>10} {:5} {:>8} {:>8}\n", "bench", "case", "metric", "value",
               "unit", "bound", "target");
    const auto optional = [](const std::optional<double>& value) {
        return value ? fmt::format("{:.2f}", *value) : std::string("-");
    };
    for (const Figure& figure : figures) {
        fmt::print("{:12} {:18} {:28} {:10.2f} {:5} {:>8} {:>8}\n", figure.bench, figure.name,
                   figure.metric, figure.value, figure.unit, optional(figure.bound),
                   optional(figure.target));
    }
}

nlohmann::ordered_json json(const std::vector<Figure>& figures) {
    auto list = nlohmann::ordered_json::array();
    for (const Figure& figure : figures) {
        nlohmann::ordered_json entry{{"bench", figure.bench},   {"case", figure.name},
                                     {"metric", figure.metric}, {"value", figure.value},
                                     {"unit", figure.unit},     {"better", figure.better}};
        if (figure.bound) {
            entry["bound"] = *figure.bound;
        }
        if (figure.target) {
            entry["target"] = *figure.target;
        }
        list.push_back(entry);
    }
    return list;
}

int bench_main(int count, char** arguments) {
    cli::CommandLine line("gazeloop_bench", "Measures gazeloop");
    cli::Command program = line.program();
    std::string name;
    std::string json_file;
    Options options;
    program.option("name", name, "which one; all without it");
    program.option("--json", json_file, "also write the figures as JSON");
    program.option("--spp", options.samples, "samples per texel or pixel").number_between(1, 16);
    program.option("--rounds", options.rounds, "interleaved rounds; medians are printed")
        .number_between(1, 100);
    program.flag("--quick", options.quick,
                 "small pictures and few of them, to see that a bench runs: its figures then say "
                 "little; of headline, lightfield, layers, sparse");
    program.option("--case", options.cases, "only this case; may be repeated");
    program.option("--scene", options.scenes,
                   "a scene's file besides the built-in scenes, of headline; may be repeated");
    program.option("--trace", options.trace, "recorded gaze, for benches that follow one");
    program
        .option("--against", options.against,
                "the gazeloop program of another build, for the bench report: it makes the "
                "session of an hour, which both then read in turns, and gives the ratios")
        .type("FILE");
    const auto parsed =
        line.parse(std::vector<std::string>(arguments + std::min(count, 1), arguments + count));
    if (!parsed) {
        return code(say(parsed.error()));
    }
    if (name.empty() || name == "devices") {
        begin_under_umockdev(arguments);
    }
    std::vector<Figure> figures;
    bool found = false;
    for (const Named& bench : kBenches) {
        if (name.empty() || name == bench.name) {
            found = true;
            const std::vector<Figure> more = bench.run(options);
            figures.insert(figures.end(), more.begin(), more.end());
        }
    }
    if (!found) {
        fmt::print(stderr, "error: there is no bench '{}'; there are:", name);
        for (const Named& bench : kBenches) {
            fmt::print(stderr, " {}", bench.name);
        }
        fmt::print(stderr, "\n");
        return code(cli::ExitCode::Usage);
    }
    if (options.quick) {
        // Small pictures are held to no target.
        for (Figure& figure : figures) {
            figure.target.reset();
        }
    }
    print(figures);
    if (!json_file.empty()) {
        std::ofstream out(json_file);
        out << json(figures).dump(2) << '\n';
        if (!out.flush()) {
            fmt::print(stderr, "error: {} cannot be written\n", json_file);
            return code(cli::ExitCode::BadInput);
        }
    }
    for (const std::string& wanted : options.cases) {
        if (std::ranges::find(figures, wanted, &Figure::name) == figures.end()) {
            fmt::print(stderr, "error: {} no case '{}'; a run without --case names them\n",
                       name.empty() ? "there is" : fmt::format("bench {} has", name), wanted);
            return code(cli::ExitCode::Usage);
        }
    }
    return 0;
}

}  // namespace

bool Options::wants(std::string_view name) const {
    return cases.empty() || std::ranges::find(cases, name) != cases.end();
}

double median(std::vector<double> values) {
    std::ranges::sort(values);
    const std::size_t middle = values.size() / 2;
    return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

}  // namespace gazeloop::bench

int main(int count, char** arguments) {
    try {
        return gazeloop::bench::bench_main(count, arguments);
    } catch (const gazeloop::SetupError& error) {
        fmt::print(stderr, "error: {}\n", error.what());
        return static_cast<int>(gazeloop::cli::exit_code(error.kind()));
    } catch (const std::exception& error) {
        fmt::print(stderr, "error: {}\n", error.what());
        return static_cast<int>(gazeloop::cli::ExitCode::NoDevice);
    }
}

// Any words as the options of `run`, one a line: settings in range, or a refusal.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "drivers/fixed/fixed_source.h"
#include "runtime/cli/run_options.h"

namespace {

void require(bool held) {
    if (!held) {
        std::abort();
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace gazeloop;
    std::vector<std::string> words;
    const std::string text(data, data + size);
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        // Files are another target's business; here a name might be one of this machine's.
        if (!text.substr(begin, end - begin).starts_with("--config")) {
            words.push_back(text.substr(begin, end - begin));
        }
        begin = end + 1;
    }

    cli::CommandLine line("", "");
    cli::RunOptions options;
    std::string gaze;
    options.add_to(line.program());
    line.program().option("--gaze", gaze, "");
    try {
        if (!line.parse(words)) {
            return 0;
        }
    } catch (const SetupError& refusal) {
        require(refusal.kind() == ErrorKind::Usage);
        return 0;
    }
    require(options.frames.value_or(0) >= 0);
    require(options.seconds.value_or(0.0) >= 0.0 && std::isfinite(options.seconds.value_or(0.0)));
    if (const auto fixed = drivers::parse_fixed_gaze(gaze); !fixed) {
        require(fixed.error().kind == ErrorKind::Usage && !fixed.error().message.empty());
    }
    run::ProgramSettings settings;
    if (const auto applied = options.apply_to(settings, false)) {
        const run::ProgramValues& values = settings.values();
        require(values.methods.kfr.sigma >= 0.5 && values.methods.kfr.sigma <= 32.0);
        require(values.render.spp >= 1 && values.render.spp <= 16);
        require(std::isfinite(values.gaze.hold_ms) && values.gaze.hold_ms >= 0.0);
        (void)settings.check();
    } else {
        require(applied.error().kind == ErrorKind::Usage && !applied.error().message.empty());
    }
    return 0;
}

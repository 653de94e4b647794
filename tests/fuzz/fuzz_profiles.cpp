// Any bytes as a profile of a display, a tracker or a budget: one that can be used, or an error
// that names the file.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "runtime/profiles/profiles.h"
#include "tests/support/temporary_folder.h"

namespace {

void require(bool held) {
    if (!held) {
        std::abort();
    }
}

void require_named(const gazeloop::Error& error, const std::string& file) {
    require(error.kind == gazeloop::ErrorKind::BadInput &&
            error.message.find(file) != std::string::npos);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace gazeloop;
    static const tests::TemporaryFolder folder;
    const std::string file = folder / "profile.toml";
    std::ofstream(file, std::ios::binary | std::ios::trunc)
        .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
    if (const auto display = profiles::load_display(file)) {
        for (const gaze::FieldOfView& fov : display->fov) {
            require(gaze::is_valid(gaze::EyeView{
                .fov = fov, .width_px = display->width_px, .height_px = display->height_px}));
        }
        require(display->period_ns() > 0 && std::isfinite(display->ipd_m));
    } else {
        require_named(display.error(), file);
    }
    if (const auto tracker = profiles::load_tracker(file)) {
        require(tracker->delay_ns >= 0);
    } else {
        require_named(tracker.error(), file);
    }
    if (const auto budget = profiles::load_budget(file)) {
        bool any = budget->total_ns.has_value();
        for (const auto& limit_ns : budget->stages_ns) {
            require(!limit_ns || (*limit_ns > 0 && *limit_ns <= 1'000'000'000));
            any = any || limit_ns.has_value();
        }
        require(any);
    } else {
        require_named(budget.error(), file);
    }
    return 0;
}

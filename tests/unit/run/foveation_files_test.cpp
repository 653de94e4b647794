// The settings of config/foveation, which `gazeloop trade --fitted` made.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "runtime/methods/registry.h"
#include "runtime/profiles/profiles.h"
#include "runtime/run/program_settings.h"

namespace gazeloop::run {
namespace {

namespace fs = std::filesystem;

TEST(FoveationFiles, AreSettingsThatTheirDisplaysPicturesTake) {
    std::size_t files = 0;
    for (const fs::directory_entry& one :
         fs::directory_iterator(fs::path(GAZELOOP_SOURCE_DIR) / "config/foveation")) {
        const std::string name = one.path().stem().string();
        ProgramSettings settings;
        const auto loaded = settings.load(one.path());
        ASSERT_TRUE(loaded) << loaded.error().message;
        EXPECT_TRUE(settings.check()) << name;
        // DISPLAY-METHOD-FEWER.
        const std::string method = settings.values().render.method;
        const std::size_t at = name.find('-' + method + '-');
        ASSERT_NE(at, std::string::npos) << name;
        const auto display = profiles::load_display(name.substr(0, at));
        ASSERT_TRUE(display) << display.error().message;
        const methods::Method& found = *methods::find_method(method);
        EXPECT_TRUE(found.passes(settings.values().methods, settings)) << name;
        const auto checked = found.check_picture(settings.values().methods, settings,
                                                 {display->width_px, display->height_px});
        EXPECT_TRUE(checked) << name << ": " << checked.error().message;
        ++files;
    }
    EXPECT_GE(files, 2U);
}

}  // namespace
}  // namespace gazeloop::run

#pragma once

#include <cmath>
#include <cstdlib>
#include <fstream>

#include "tests/support/faults/injected.h"
#include "tests/support/temporary_folder.h"

namespace gazeloop::tests {

/// As long as it lives, OpenXR runtimes of this process have an eye tracker: a layer that plays a
/// gaze which wanders to both sides (tests/support/openxr_layer/eye_gaze.cpp).
class PlayedGaze {
  public:
    PlayedGaze() : environment_(openxr_faults("")) {
        std::ofstream gaze(folder_ / "gaze.txt");
        for (int i = 0; i < 12000; ++i) {
            gaze << i / 120.0 << ' ' << 0.2 * std::sin(i / 50.0) << " 0.1 -1\n";
        }
        environment_.emplace_back("GAZELOOP_OPENXR_GAZE", folder_ / "gaze.txt");
        for (const auto& [name, value] : environment_) {
            setenv(name.c_str(), value.c_str(), 1);
        }
    }
    PlayedGaze(const PlayedGaze&) = delete;
    PlayedGaze& operator=(const PlayedGaze&) = delete;
    ~PlayedGaze() {
        for (const auto& [name, value] : environment_) {
            unsetenv(name.c_str());
        }
    }

  private:
    TemporaryFolder folder_;
    Environment environment_;
};

}  // namespace gazeloop::tests

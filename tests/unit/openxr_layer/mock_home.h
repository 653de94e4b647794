#pragma once

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>

#include "tests/support/temporary_folder.h"

namespace gazeloop::openxr_layer {

/// The layer's settings, a line each.
inline void set_settings(const std::string& lines) {
    setenv("GAZELOOP_LAYER_SETTINGS", lines.c_str(), 1);
}

/// Files of the layer go into a folder of the test's.
struct Home {
    Home() {
        for (const char* const name : {"XDG_CONFIG_HOME", "XDG_STATE_HOME", "XDG_DATA_HOME"}) {
            setenv(name, folder.path().c_str(), 1);
        }
    }
    /// What the layer has logged.
    [[nodiscard]] std::string log() const {
        std::ifstream in(folder.path() / "gazeloop/layer/layer.log");
        return {std::istreambuf_iterator<char>(in), {}};
    }
    tests::TemporaryFolder folder;
};

}  // namespace gazeloop::openxr_layer

#pragma once

#include <string>

namespace gazeloop::tests {

/// A plan of a study that takes seconds: two cells of kfr.sigma and a validation trial, pictures
/// that last some frames.
inline std::string small_study(const std::string& name) {
    return "format = \"gazeloop-study\"\nversion = 1\nname = \"" + name + R"("
design = "2afc"
method = "kfr"
validation = 0.34
shown_s = 0.15
black_s = 0.02
rest_s = 0.0
[[factor]]
name = "sigma"
key = "kfr.sigma"
levels = [1.2, 3.2]
)";
}

}  // namespace gazeloop::tests

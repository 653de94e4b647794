#pragma once

#include <string>

namespace gazeloop {

/// A setting, a property of a device, a fact about a run: both as text.
struct NamedValue {
    std::string name;
    std::string value;
};

}  // namespace gazeloop

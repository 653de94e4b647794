#include "tests/support/faults/fault_plan.h"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <cstdlib>

namespace gazeloop::tests {
namespace {

std::uint64_t number(std::string_view text) {
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size() || value == 0) {
        refuse_fault("a plan", text);
    }
    return value;
}

}  // namespace

FaultPlan::FaultPlan(std::string_view text) {
    while (!text.empty()) {
        const std::string_view one = text.substr(0, text.find(';'));
        text.remove_prefix(std::min(one.size() + 1, text.size()));
        const std::size_t at = one.find('@');
        const std::size_t equals = one.find('=');
        if (at == std::string_view::npos || equals == std::string_view::npos || equals < at) {
            refuse_fault("a plan", one);
        }
        const std::string_view calls = one.substr(at + 1, equals - at - 1);
        const std::size_t plus = calls.find('+');
        faults_.push_back(
            {.function = std::string(one.substr(0, at)),
             .first = number(calls.substr(0, plus)),
             .count = plus == std::string_view::npos ? 1 : number(calls.substr(plus + 1)),
             .effect = std::string(one.substr(equals + 1))});
    }
}

FaultPlan FaultPlan::from_environment(const char* variable) {
    const char* const text = std::getenv(variable);
    return FaultPlan(text != nullptr ? text : "");
}

std::optional<std::string_view> FaultPlan::call(std::string_view function) {
    auto counted = calls_.find(function);
    if (counted == calls_.end()) {  // later calls allocate nothing, which some tests count
        counted = calls_.emplace(function, 0).first;
    }
    const std::uint64_t number = ++counted->second;
    const auto due = std::ranges::find_if(faults_, [&](const Fault& fault) {
        return fault.function == function && number >= fault.first &&
               number - fault.first < fault.count;
    });
    return due == faults_.end() ? std::nullopt : std::optional<std::string_view>(due->effect);
}

void refuse_fault(std::string_view function, std::string_view effect) {
    std::fprintf(stderr, "fault layer: '%.*s' is no fault of %.*s\n",
                 static_cast<int>(effect.size()), effect.data(), static_cast<int>(function.size()),
                 function.data());
    std::abort();
}

}  // namespace gazeloop::tests

#pragma once

#include <exception>
#include <memory>
#include <optional>
#include <span>
#include <string_view>

#include "runtime/openxr_layer/instances.h"
#include "runtime/openxr_layer/layer_log.h"

namespace gazeloop::openxr_layer {

/// A call that the layer stands in for, and its way down. It must not outlive what it is made of.
template <auto Next>
class Call {
  public:
    explicit Call(const Instances::Pointer& instance) : instance_(instance) {}

    [[nodiscard]] LayeredInstance& instance() const { return *instance_; }
    [[nodiscard]] const Instances::Pointer& pointer() const { return instance_; }
    [[nodiscard]] const NextFunctions& next() const { return instance_->next; }

    /// What is below answers; what it said is remembered.
    template <typename... Arguments>
    XrResult down(Arguments... arguments) {
        result_ = (instance_->next.*Next)(arguments...);
        return *result_;
    }
    [[nodiscard]] const std::optional<XrResult>& result() const { return result_; }

  private:
    const Instances::Pointer& instance_;
    std::optional<XrResult> result_;
};

template <auto Next, auto Work, typename Function>
struct Guarded;

/// Nothing that goes wrong in the layer's work leaves it: the call is then what it would have been
/// without the layer, as far as it had not gone down already.
template <auto Next, auto Work, typename First, typename... Rest>
struct Guarded<Next, Work, XrResult(XRAPI_PTR*)(First, Rest...)> {
    static XRAPI_ATTR XrResult XRAPI_CALL call(First first, Rest... rest) noexcept {
        const Instances::Pointer instance = Instances::all().of(first);
        if (instance == nullptr) {
            return XR_ERROR_HANDLE_INVALID;
        }
        Call<Next> call(instance);
        try {
            return Work(call, first, rest...);
        } catch (const std::exception& error) {
            say(LogLevel::Warning, error.what());
        } catch (...) {
            say(LogLevel::Warning, "an error without a name: the call passes through");
        }
        return call.result() ? *call.result() : call.down(first, rest...);
    }
};

/// A function by its name, and what stands in for it.
struct Hook {
    std::string_view name;
    PFN_xrVoidFunction function;
    /// Whether an instance has it: where the one below has none, there is nothing to stand in for.
    bool (*is_there)(const LayeredInstance&);
};

template <auto Next, auto Work>
Hook hook(std::string_view name) {
    using Function = std::remove_cvref_t<decltype(std::declval<NextFunctions>().*Next)>;
    return {name, reinterpret_cast<PFN_xrVoidFunction>(&Guarded<Next, Work, Function>::call),
            [](const LayeredInstance& layered) { return layered.next.*Next != nullptr; }};
}

template <auto Work, typename Function>
struct Own;

/// A function that is the layer's alone.
template <auto Work, typename First, typename... Rest>
struct Own<Work, XrResult(XRAPI_PTR*)(First, Rest...)> {
    static XRAPI_ATTR XrResult XRAPI_CALL call(First first, Rest... rest) noexcept {
        const Instances::Pointer instance = Instances::all().of(first);
        if (instance == nullptr) {
            return XR_ERROR_HANDLE_INVALID;
        }
        try {
            return Work(instance, first, rest...);
        } catch (const std::exception& error) {
            say(LogLevel::Warning, error.what());
        } catch (...) {
            say(LogLevel::Warning, "an error without a name");
        }
        return XR_ERROR_RUNTIME_FAILURE;
    }
};

template <typename Function, auto Work>
Hook own_hook(std::string_view name, bool (*is_there)(const LayeredInstance&)) {
    return {name, reinterpret_cast<PFN_xrVoidFunction>(&Own<Work, Function>::call), is_there};
}

// The hooked functions, by what they concern.
std::span<const Hook> instance_hooks();
std::span<const Hook> action_hooks();
std::span<const Hook> space_hooks();
std::span<const Hook> frame_hooks();
std::span<const Hook> foveation_hooks();
std::span<const Hook> quad_view_hooks();

/// The structure of that type in a chain; null where there is none.
template <typename Structure>
Structure* in_chain(void* next, XrStructureType type) {
    auto* link = static_cast<XrBaseOutStructure*>(next);
    while (link != nullptr && link->type != type) {
        link = link->next;
    }
    return reinterpret_cast<Structure*>(link);
}
template <typename Structure>
const Structure* in_chain(const void* next, XrStructureType type) {
    const auto* link = static_cast<const XrBaseInStructure*>(next);
    while (link != nullptr && link->type != type) {
        link = link->next;
    }
    return reinterpret_cast<const Structure*>(link);
}

}  // namespace gazeloop::openxr_layer

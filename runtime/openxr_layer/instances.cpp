#include "runtime/openxr_layer/instances.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <new>

#include "runtime/openxr_layer/layer_log.h"

namespace gazeloop::openxr_layer {

struct Instances::AtEnd {
    AtEnd() = default;
    AtEnd(const AtEnd&) = delete;
    AtEnd& operator=(const AtEnd&) = delete;
    ~AtEnd() { all().end(); }
};

/// Never destroyed: a program that ends may have threads in the layer's functions.
Instances& Instances::all() {
    alignas(Instances) static std::array<std::byte, sizeof(Instances)> memory;
    static Instances& the_instances = *new (memory.data()) Instances;
    static const AtEnd at_end;
    return the_instances;
}

void Instances::end() {
    std::vector<Pointer> left;
    {
        const std::lock_guard lock(mutex_);
        left = instances_;
        if (left.empty()) {  // the library is unloaded: it leaves no memory behind
            std::vector<Pointer>().swap(instances_);
            std::unordered_map<Key, Child, KeyHash>().swap(children_);
            forget_said();
        }
    }
    for (const Pointer& instance : left) {
        instance->end_without_the_application();
    }
}

void Instances::add(const Pointer& instance) {
    const std::lock_guard lock(mutex_);
    instances_.push_back(instance);
}

void Instances::remove(XrInstance instance) {
    Pointer last;  // its end, which may join threads, comes without the lock
    const std::lock_guard lock(mutex_);
    const auto found = std::ranges::find(instances_, instance, &LayeredInstance::handle);
    if (found != instances_.end()) {
        last = *found;
        std::erase_if(children_, [&](const auto& one) { return one.second.instance == last; });
        instances_.erase(found);
    }
}

void Instances::remove_session(XrSession session) {
    const std::lock_guard lock(mutex_);
    std::erase_if(children_, [session](const auto& one) { return one.second.session == session; });
}

Instances::Pointer Instances::of(XrInstance instance) const {
    const std::lock_guard lock(mutex_);
    const auto found = std::ranges::find(instances_, instance, &LayeredInstance::handle);
    return found != instances_.end() ? *found : nullptr;
}

Instances::Pointer Instances::of_child(const Key& child) const {
    const std::lock_guard lock(mutex_);
    if (instances_.size() == 1) {
        return instances_.front();  // as mostly: nothing is looked for
    }
    if (const auto found = children_.find(child); found != children_.end()) {
        return found->second.instance;
    }
    return instances_.empty() ? nullptr : instances_.back();
}

XrSession Instances::session_of_child(const Key& child) const {
    const std::lock_guard lock(mutex_);
    const auto found = children_.find(child);
    return found != children_.end() ? found->second.session : XR_NULL_HANDLE;
}

}  // namespace gazeloop::openxr_layer

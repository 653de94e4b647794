#include "runtime/openxr_layer/instances.h"

#include <algorithm>

namespace gazeloop::openxr_layer {

Instances& Instances::all() {
    static Instances the_instances;
    return the_instances;
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

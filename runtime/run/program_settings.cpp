#include "runtime/run/program_settings.h"

#include "runtime/methods/registry.h"
#include "sim/simulation_settings.h"

namespace gazeloop::run {

ProgramSettings::ProgramSettings() {
    // By name, so that none is forgotten.
    auto& [gaze, governor, hid, layer, light_field, methods, monitor, openxr, profile, render, sim,
           steam_frame, target, trace, virtual_time, vulkan] = values_;
    add(rows_of(gaze));
    add(rows_of(governor));
    add(rows_of(hid));
    add(rows_of(layer));
    add(rows_of(light_field));
    add(rows_of(methods));
    add(rows_of(monitor));
    add(rows_of(openxr));
    add(rows_of(profile));
    add(rows_of(render, methods::rendered_methods()));
    add(rows_of(sim));
    add(rows_of(steam_frame));
    add(rows_of(target));
    add(rows_of(trace));
    add(rows_of(virtual_time));
    add(rows_of(vulkan));
}

Expected<void> ProgramSettings::check() const {
    if (auto fits = methods::check_kfr(*this); !fits) {
        return fits;
    }
    return gaze::check(values_.gaze, *this);
}

}  // namespace gazeloop::run

#include "runtime/simulate/gaze_file.h"

#include <array>

#include "drivers/trace/native_trace.h"
#include "sim/gaze_generator.h"

namespace gazeloop::simulate {

std::size_t write_gaze_file(const sim::GazeSimulation& simulation, double seconds,
                            const std::string& file, std::span<const report::NamedFile> reads) {
    if (file == "-") {
        throw SetupError(ErrorKind::Usage,
                         "simulate gaze -: a trace is a file with a second one beside it that "
                         "describes it: name the file, or /dev/stdout for the trace alone");
    }
    const std::array<report::NamedFile, 2> outputs{
        {{"OUT", file}, {"what describes it", file + ".json"}}};
    value_or_throw(report::check_outputs(outputs, reads));
    const gaze::GazeTrace trace = sim::generate_gaze(simulation, seconds);
    if (trace.samples.empty()) {
        throw SetupError(ErrorKind::Usage, "sim.dropout_percent: no sample is left to write");
    }
    value_or_throw(drivers::write_native_trace(trace, file));
    return trace.samples.size();
}

}  // namespace gazeloop::simulate

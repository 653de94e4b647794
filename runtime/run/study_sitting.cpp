#include "runtime/run/study_sitting.h"

#include <fmt/core.h>

#include <memory>
#include <utility>
#include <vector>

#include "runtime/run/study_request.h"
#include "runtime/study/controls.h"
#include "runtime/study/plan_file.h"
#include "runtime/study/sittings.h"

namespace gazeloop::run {

std::optional<ErrorKind> run_sitting(const StudySitting& sitting, ProgramSettings& settings,
                                     FrameRunRequest& request) {
    if (request.record) {
        throw SetupError(ErrorKind::Usage,
                         "study run: every sitting is recorded in --folder: leave out --record");
    }
    ProgramSettings known;
    const study::Plan plan = value_or_throw(study::read_plan(sitting.plan, &known));
    value_or_throw(take_plan(plan, settings));
    study::TrialQueue queue(plan, sitting.subject);
    const study::Sittings sittings =
        value_or_throw(study::find_sittings(plan, sitting.subject, sitting.folder));
    value_or_throw(queue.resume(sittings.responses));
    if (queue.next() == nullptr) {
        fmt::print("subject {} has answered all of {}\n", sitting.subject, plan.name);
        return std::nullopt;
    }
    study::SimulatedPeople people;
    if (sitting.simulated) {
        people = study::people_of(*sitting.simulated, plan);
    }
    std::unique_ptr<study::SubjectInput> input;
    if (sitting.simulated) {
        input = study::simulated_input(plan, people, sitting.subject);
    } else {
        auto person = study::person_input(plan.design);
        request.take_presses = [&listening = *person](std::vector<present::ButtonSource*> sources) {
            listening.listen_to(std::move(sources));
        };
        input = std::move(person);
    }
    study::StudyRun study(plan, queue, sitting.subject, *input,
                          [](const std::string& line) { fmt::print(stderr, "{}\n", line); });
    show_study(study, settings, request);
    request.record = sittings.next;
    if (!sitting.quiet) {
        fmt::print(stderr, "{}: subject {}, {} trials left; {}\n", plan.name, sitting.subject,
                   queue.left(), study::controls_text(plan.design));
    }
    const auto failure = frame_run(request);
    fmt::print(stderr, "{} answers, {} trials left; recorded to {}\n", study.answers(),
               study.left(), sittings.next.string());
    if (study.nobody_answers() && !study.over()) {
        throw SetupError(ErrorKind::Usage,
                         "the standard input has ended, and there is no controller: nobody can "
                         "answer; run it in a terminal, with --preview (keys and gamepads in its "
                         "window), on OpenXR, or with --simulated");
    }
    if (study.too_slow()) {
        throw SetupError(ErrorKind::NoDevice,
                         "this machine is too slow for the plan's times: pictures were over before "
                         "they were drawn; use a smaller picture (--set render.scale=0.3)");
    }
    return failure;
}

}  // namespace gazeloop::run

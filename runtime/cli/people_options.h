#pragma once

#include "runtime/command_line/command_line.h"
#include "runtime/study/people_question.h"

namespace gazeloop::cli {

/// Whom `study power`, `study simulate` and `study run --simulated` simulate.
struct PeopleOptions {
    study::PeopleQuestion question;

    void add_to(Command app);
    /// What people are like, without how much they see.
    void add_terms_to(Command app);
};

}  // namespace gazeloop::cli

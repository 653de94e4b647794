#include "runtime/cli/trade_options.h"

namespace gazeloop::cli {

void TradeOptions::add_to(Command command) {
    std::vector<Option> measured;  // what decides what is measured
    measured.push_back(command
                           .option("--scenes", asked.scenes,
                                   "several scenes instead of --scene, with commas between")
                           .type("LIST")
                           .not_empty());
    measured.push_back(
        command.option("--methods", asked.methods, "which, with commas between (kfr,acuity)")
            .type("LIST")
            .not_empty());
    measured.push_back(
        command.option("--sigma", asked.sigmas, "values of kfr.sigma, with commas between")
            .type("LIST")
            .not_empty());
    measured.push_back(
        command.option("--alpha", asked.alphas, "values of kfr.alpha").type("LIST").not_empty());
    measured.push_back(
        command.option("--mar", asked.slopes, "values of acuity.mar").type("LIST").not_empty());
    measured.push_back(
        command
            .option(
                "--vary", asked.varied,
                "values of any setting of a method, or filter of render.*; may be repeated: all "
                "combinations are rendered")
            .type("KEY=V1,V2,..."));
    Option worth = command
                       .option("--worth", asked.worth,
                               "what each part of this method costs and is worth: its settings and "
                               "the filters, each changed alone")
                       .type("METHOD")
                       .not_empty();
    for (std::size_t other = 1; other < measured.size(); ++other) {  // all but --scenes
        worth.not_with(measured[other]);
    }
    measured.push_back(worth);
    Option fitted =
        command
            .option("--fitted", asked.outputs.fitted,
                    "of --methods kfr or interleaved alone, look for the shape of the buffer that "
                    "loses least, and write it as settings (.toml)")
            .type("FILE")
            .not_empty();
    for (std::size_t other = 2; other < measured.size(); ++other) {  // all but these and --methods
        fitted.not_with(measured[other]);
    }
    measured.push_back(fitted);
    measured.push_back(command
                           .option("--fewer", asked.fewer,
                                   "with --fitted: so many times fewer samples than pixels (12)")
                           .number_between(1.5, 1000)
                           .only_with(fitted));
    measured.push_back(
        command.flag("--published-grid", asked.published,
                     "also every sigma and alpha of the KFR paper's pilot study (58 points)"));
    measured.back().not_with(worth).not_with(fitted);
    measured.push_back(
        command.option("--frames", asked.frames, "frames at the display's rate (4); 1: a still")
            .number_between(1, 100'000));
    measured.push_back(command
                           .option("--rounds", asked.rounds,
                                   "how often each frame is timed, all points in turns (3)")
                           .number_between(1, 1000));
    measured.push_back(command
                           .option("--reference-spp", asked.reference_samples,
                                   "samples per pixel of the reference, 1 to 16 (16)")
                           .number_between(1, 16));
    for (const Option& option : quality.add_to(command, &gazes)) {
        measured.push_back(option);
    }
    command
        .option("--budget-ms", asked.budget_ms,
                "recommend the best point whose frames take no longer")
        .number_between(1e-3, 1e6);
    command
        .option("--limit", asked.limits,
                "recommend the fastest point of which this figure's mean is no worse; may be "
                "repeated")
        .type("FIGURE=NUMBER");
    command.flag("--fit", asked.fit,
                 "fit how cells, time and quality follow each method's settings");
    measured.push_back(
        command
            .option("--resume", asked.journal,
                    "keep all that is measured in this file, and go on where it ends")
            .type("FILE")
            .not_empty());
    measured.push_back(command
                           .option("--shard", asked.shard,
                                   "measure every N-th point alone, from the I-th on (1/1)")
                           .type("I/N"));
    // What is looked for is not kept, and each shard would look for it anew.
    measured[measured.size() - 2].not_with(fitted);
    // Every part is held against the method as it is, in the same turns.
    measured.back().not_with(worth).not_with(fitted);
    Option merge =
        command
            .option("--merge", asked.merge,
                    "measure nothing: report what --resume kept of the shards; may be repeated")
            .type("FILE");
    for (const Option& option : measured) {
        merge.not_with(option);
    }
    command.option("--csv", asked.outputs.csv, "write a line per case and point")
        .type("FILE")
        .not_empty();
    command
        .option("--front", asked.outputs.front,
                "write the front of time and the first figure as levels of a governor (.toml)")
        .type("FILE")
        .not_empty();
    command.option("--html", asked.outputs.html, "write one page with plots, tables and pictures")
        .type("FILE")
        .not_empty();
}

trade::TradeRequest TradeOptions::request() const {
    trade::TradeRequest request = asked;
    request.eye = quality.which_eye();
    request.metrics = quality.metric_choice();
    request.contrast = quality.contrast();
    return request;
}

}  // namespace gazeloop::cli

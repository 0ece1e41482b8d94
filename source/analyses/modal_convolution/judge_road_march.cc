#include <vibrocontact/analyses/modal_convolution/judge_road_march.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/marching/judge_march.h>
#include <vibrocontact/output/verdict.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  namespace
  {
    constexpr double most_created_work = 0.01, most_unseen_road = 0.2, most_at_open_sides = 0.01;

    /// of the steps, or of waves between them, which add their square
    double rms_error(const ModalConvolutionResult &result)
    {
      return std::max(result.errors.rms_force, std::hypot(1., result.unseen_share()) - 1);
    }

    void say_work_of(const WorkAccount &work)
    {
      Log &log = run_log();
      log.value("work of the road", work.input, "J");
      log.value("given back to it", work.returned, "J");
      if (work.impacts > 0)
        log.value("lost in impacts", work.impacts, "J");
      if (!work.has_modes)
        return log.value("went into the body", work.work(), "J");
      log.value("stored, at the beginning " + number_text(work.initial) + " J", work.stored, "J");
      log.value("damped", work.damping, "J");
      log.value("energy account open by", work.imbalance(), "J");
    }
  } // namespace

  void judge_road_march(const ModalConvolutionParameters &parameters, const ModalConvolution &motion,
                        const bool is_passive, const bool is_whole, nlohmann::ordered_json &json,
                        Results &results)
  {
    const ModalConvolutionResult &result = motion.result();
    const RoadMarchErrors &errors = result.errors;
    const WorkAccount &work = result.work;
    const std::string second = motion.second_march();
    const ErrorReport report = {
        "modal convolution",
        "Modal convolution",
        second,
        {{"estimated_error", "impulse", errors.impulse},
         {"estimated_error_rms_force", "rms force", rms_error(result), result.rms_force()}}};
    if (say_errors(errors, report, json))
      json["estimated_error_worst_point"] = errors.worst_point;
    if (!second.empty())
      json["error_estimate"]["seconds_per_step"] = errors.seconds / std::max(1ul, result.steps);
    say_work_of(work);
    if (!parameters.is_event_located())
      json["unseen_road_share"] = result.unseen_share();
    if (!is_whole)
      return;
    const auto fail = [&](const std::string &text) { refuse(text, results); };
    const std::string shorter =
        parameters.is_event_located() ? "" : " Take a shorter Modal convolution/Time step.";
    const bool forgets = parameters.is_convolution() && parameters.memory > 0;
    if (!errors.failure.empty())
      fail("The error of the modal convolution is not known: " + second + " ended early, " + errors.failure);
    else
      judge_errors(errors, report,
                   forgets ? " Take a longer Modal convolution/Memory, or a shorter Time step." : shorter,
                   results);
    const double unseen = result.unseen_share();
    if (!(unseen <= most_unseen_road))
      fail("The road has waves between the steps of the modal convolution, which do not see them: they would "
           "change the force by " +
           percent_text(unseen) + " of its rms." + shorter);
    if (result.forces_at_sides > most_at_open_sides * result.forces_meanwhile)
      fail("The contact reaches the outermost contact points, which take " +
           percent_text(result.forces_at_sides / result.forces_meanwhile) +
           " of the force while they are closed: the body touches beside them too, where nothing carries. "
           "Give it more contact points, or lower the load.");
    if (work.has_modes && !(std::abs(work.imbalance()) <= most_open_energy * work.available()))
      fail("The energy account of the modal convolution does not close: " + number_text(work.initial) +
           " J at the start and " + number_text(work.input) + " J put in, and " +
           number_text(work.imbalance()) + " J of them are not where they went." + shorter);
    else if (is_passive && -work.least_work > work.initial + most_created_work * work.input)
      fail("The body gives " + number_text(-work.least_work) +
           " J more to the contact than it got (the road put in " + number_text(work.input) +
           " J): its data create energy, as those with a delay, another sign or of another kind do. See what "
           "the identification says about them, or take a shorter Time step if they are right.");
  }
} // namespace vibrocontact

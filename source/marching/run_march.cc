#include <vibrocontact/base/collective.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/marching/checkpoint_schedule.h>
#include <vibrocontact/marching/run_march.h>
#include <vibrocontact/output/verdict.h>

#include <sstream>

namespace vibrocontact
{
  bool resume_march(const std::string &name, March &march, const MarchCheckpoint &checkpoint,
                    const Recorders &recorders)
  {
    bool found = false;
    on_all_ranks([&] { found = checkpoint.read(march, recorders); });
    if (found)
      run_log().value("resumed at", march.time(), "s");
    else
      run_log().line("There is no checkpoint: the " + name + " starts from its beginning.");
    return found;
  }

  bool run_march(const std::string &name, March &march, const MarchCheckpoint &checkpoint,
                 const double interval, const Recorders &recorders, Results &results)
  {
    bool is_whole = march.is_over(), is_stored = true;
    std::ostringstream failure;
    Progress progress(name, march.end_time() - march.time());
    CheckpointSchedule schedule(interval);
    while (!is_whole && schedule.stopped_by() == 0)
    {
      const double before = march.time();
      try
      {
        // a recorder that cannot write is heard of by all
        on_all_ranks([&] { march.advance_part(schedule.n_steps()); });
      }
      catch (const ConvergenceError &error)
      {
        failure << "The " << name << " ended at " << march.time() << " s: " << error.what();
        break;
      }
      progress.advance(march.time() - before, [&] { return march.pace(); });
      is_whole = march.is_over();
      is_stored = schedule.is_due(is_whole || march.is_between_blocks()) || is_whole;
      if (is_stored)
        on_first_rank([&] { checkpoint.write(march, recorders); });
    }
    on_first_rank(
        [&]
        {
          for (Recorder *const recorder : recorders)
            recorder->finish(is_whole);
        });
    if (is_whole)
      schedule.is_due(); // a signal in the last steps stops what would follow
    results.stopped_by = schedule.stopped_by();
    if (results.stopped_by != 0)
      run_log().warning(is_stored ? "Interrupted; a checkpoint is written, --resume continues."
                                  : "Interrupted within a block of long steps; --resume continues from the "
                                    "checkpoint at its beginning.");
    if (!failure.str().empty())
      refuse(failure.str() + (failure.str().back() == '.' ? "" : "."), results);
    return is_whole;
  }
} // namespace vibrocontact

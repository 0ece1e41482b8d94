#include <vibrocontact/base/collective.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/marching/checkpoint_schedule.h>
#include <vibrocontact/marching/run_march.h>

namespace vibrocontact
{
  bool resume_march(March &march, const MarchCheckpoint &checkpoint, const Recorders &recorders)
  {
    bool found = false;
    on_all_ranks([&] { found = checkpoint.read(march, recorders); });
    if (found)
      run_log().value("resumed at", march.time(), "s");
    else
      run_log().line("There is no checkpoint: it starts from its beginning.");
    return found;
  }

  MarchEnd run_march(const std::string &name, March &march, const MarchCheckpoint &checkpoint,
                     const double interval, const Recorders &recorders)
  {
    MarchEnd end;
    {
      Progress progress(name, march.end_time() - march.time());
      CheckpointSchedule schedule(interval);
      end.is_whole = march.is_over();
      while (!end.is_whole && schedule.stopped_by() == 0)
      {
        const double before = march.time();
        try
        {
          // a recorder that cannot write is heard of by all
          on_all_ranks([&] { march.advance_block(); });
        }
        catch (const ConvergenceError &error)
        {
          end.failure = error.what();
          break;
        }
        progress.advance(march.time() - before, [&] { return march.pace(); });
        end.is_whole = march.is_over();
        if (schedule.is_due() || end.is_whole)
          on_first_rank([&] { checkpoint.write(march, recorders); });
      }
      on_first_rank(
          [&]
          {
            for (Recorder *const recorder : recorders)
              recorder->finish(end.is_whole);
          });
      if (end.is_whole)
        schedule.is_due(); // a signal in the last steps stops what would follow
      end.stopped_by = schedule.stopped_by();
    }
    if (end.stopped_by != 0)
      run_log().warning("Interrupted; a checkpoint is written, --resume continues.");
    return end;
  }
} // namespace vibrocontact

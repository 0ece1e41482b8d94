#pragma once

#include <vibrocontact/marching/march.h>
#include <vibrocontact/marching/recorder.h>

#include <functional>
#include <memory>
#include <string>

namespace vibrocontact
{
  /// The checkpoint of a march in the output folder: its state and sums, what its recorders need, marks of its bodies, by
  /// which a resumed run sees that it has the same ones, and a sum over all bytes. Numbers are kept bit for bit; the file
  /// appears whole or not at all, so that a run killed while writing leaves the one before.
  class MarchCheckpoint
  {
  public:
    /// @param section of the march's entries, for messages
    /// @param format changes whenever what is exchanged or what it means does
    /// @param advice what to do where it cannot be read
    MarchCheckpoint(const std::string &file_name, const std::string &section, int format,
                    const std::string &advice = "run the file without --resume");

    /// To be called by rank 0. @throws OutputError
    void write(March &march, const Recorders &recorders) const;
    /// On every rank; recorders on rank 0. @return false: there is no checkpoint
    /// @throws InputError if it is damaged, of another version or of other bodies
    bool read(March &march, const Recorders &recorders) const;
    /// What another computation goes on from. @param marks that it has to agree with
    /// @param exchange reads it, is given the time of the march [s]
    /// @return false: there is no checkpoint @throws InputError if it is damaged, of another version or of other bodies
    bool read_part(const Marks &marks, const std::function<void(CheckpointFile &, double)> &exchange) const;
    /// @throws InputError if there is a checkpoint beyond the end time [s], or one that read() would refuse for itself
    /// @param time_step of the march, which ends at whole ones [s]
    void check_end_time(double end_time, double time_step) const;

  private:
    /// null: there is none
    std::unique_ptr<Hdf5Reader> opened() const;

    const std::string name, section;
    const int format;
    /// behind a message
    const std::string advice;
  };
} // namespace vibrocontact

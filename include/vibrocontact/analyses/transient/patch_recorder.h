#pragma once

#include <vibrocontact/analyses/transient/state_recorder.h>
#include <vibrocontact/contact/placed_contacts.h>

#include <string>
#include <vector>

namespace vibrocontact
{
  /// Frames of the contact patches in time: fields/patch_<k>.vtu (of several contacts patch_<name>_<k>.vtu) with
  /// patch.pvd on top, the points in contact
  /// only (see contact_patch_columns()).
  class PatchRecorder : public StateRecorder
  {
  public:
    /// @param begin time of the first frame, @param interval distance of the frames [s]
    PatchRecorder(const PlacedContacts &contacts, double begin, double interval, const std::string &folder);
    void add(const DynamicState &state) override;
    void exchange(CheckpointFile &file) override;
    void finish(bool at_the_end) override;

  private:
    const PlacedContacts contacts;
    const double begin, interval;
    const std::string folder;
    /// of the frames written so far [s]
    std::vector<double> times;
  };
} // namespace vibrocontact

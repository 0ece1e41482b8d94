#pragma once

#include <vibrocontact/marching/dynamic_state.h>
#include <vibrocontact/marching/march_checkpoint.h>

#include <string>

namespace vibrocontact
{
  /// In the output folder, checkpoint.h5.
  MarchCheckpoint transient_checkpoint(const std::string &folder);

  /// The state that the checkpoint of a transient in a folder of results ends with. @param entry that names the folder, for messages
  /// @throws InputError if there is none, or it is damaged, of another version or of other bodies than these
  DynamicState end_of_transient(const std::string &folder, const ContactPair &pair, const std::string &entry);
  /// @throws InputError if there is no checkpoint
  void check_end_of_transient(const std::string &folder, const std::string &entry);
} // namespace vibrocontact

#pragma once

#include <string>
#include <vector>

namespace vibrocontact
{
  /// The entries that an analysis reads: those whose value can change what it computes, given the other entries
  /// of the file. An entry that is set and that no analysis of the run reads is refused (run/check_entries.h).
  class EntriesRead
  {
  public:
    /// Entries of one section, separated by commas: `add("Transient", "Time step, End time")`; the top level is "".
    void add(const std::string &section, const std::string &names);
    /// Entries that are read where something else holds, and that in words, which messages give as the reason:
    /// `add_if(theta_method, "Transient/Integrator is theta method", "Transient", "Theta")`. Of several calls for
    /// one entry one has to hold.
    void add_if(bool holds, const std::string &condition, const std::string &section,
                const std::string &names);

    /// @param path "Section/Sub/Entry"
    bool contains(const std::string &path) const;
    /// In words what would have to hold for an entry to be read; empty if the analysis never reads it.
    std::string condition(const std::string &path) const;

  private:
    struct Row
    {
      std::string path;
      bool is_read;
      std::string condition;
    };
    std::vector<Row> rows;
  };
} // namespace vibrocontact

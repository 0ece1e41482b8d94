#pragma once

#include <string>

namespace vibrocontact
{
  /// The folder that one run at a time writes to: a lock (flock) on the file `.vibrocontact_lock` in it, which says who
  /// has it and since when. The system gives it back when the run ends in whatever way; a program that the run has
  /// started (figures) and that outlives it still has it. A file that is left behind without a lock means nothing.
  ///
  ///     const FolderLock lock("results/case", "case.prm", true);   before anything there is read or written
  ///
  /// Folders on the way are made, and removed in the end if nothing was put into them. Constructed on all ranks, held by
  /// rank 0.
  class FolderLock
  {
  public:
    /// @param purpose what the run does, for whoever is refused
    /// @param makes_folder false: without the folder there is nothing to lock
    /// @throws InputError on every rank if another run has the folder, or if nothing can be written to it
    FolderLock(const std::string &folder, const std::string &purpose, bool makes_folder);
    ~FolderLock();
    FolderLock(const FolderLock &) = delete;
    FolderLock &operator=(const FolderLock &) = delete;

  private:
    void acquire(const std::string &purpose);
    void release();

    const std::string folder, name;
    /// outermost folder that did not exist before; empty if all did
    std::string first_made;
    int descriptor = -1;
  };
} // namespace vibrocontact

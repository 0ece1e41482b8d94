#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

/// The readers of files, each as a function of the bytes of one. It returns if the reader took or refused them; whatever
/// else happens (another exception, a signal, a sanitizer's report, a hang) is a finding.
namespace readers
{
  void parameter_file(const std::string &bytes);
  /// a section
  void gmsh(const std::string &bytes);
  /// a deck of Abaqus or CalculiX and the cells in it
  void inp(const std::string &bytes);
  /// a table, then what is read of tables: receptances, poles
  void csv(const std::string &bytes);
  void uff(const std::string &bytes);
  void outline(const std::string &bytes);
  /// the first byte says what the others are: a matrix, cards of Nastran, files of CalculiX, tables of dofs and groups
  void matrices(const std::string &bytes);
  /// the section Road of a parameter file, an empty line, the table it names
  void road(const std::string &bytes);
  /// HDF5 files: the first byte says what is made of the others, see hdf5_bytes.h
  void reduction_cache(const std::string &bytes);
  void contact_problem(const std::string &bytes);
  void checkpoint(const std::string &bytes);

  struct Reader
  {
    std::string name;
    void (*read)(const std::string &bytes);
  };
  const std::vector<Reader> all = {{"parameter_file", parameter_file},
                                   {"gmsh", gmsh},
                                   {"inp", inp},
                                   {"csv", csv},
                                   {"uff", uff},
                                   {"outline", outline},
                                   {"matrices", matrices},
                                   {"road", road},
                                   {"reduction_cache", reduction_cache},
                                   {"contact_problem", contact_problem},
                                   {"checkpoint", checkpoint}};

  /// Starts MPI, silences the log, makes a folder of this process in memory and works in it. @return what ends all of this
  std::shared_ptr<void> start(char **argv);

  /// Calls a reader. An InputError or ConvergenceError is a refusal and has to carry a text in UTF-8; everything else is
  /// passed on. @return whether the reader took the input
  bool taken(const std::function<void()> &read);

  /// A file with these bytes in the folder of this process. @return its name
  std::string file_of(const std::string &name, const std::string &bytes);
} // namespace readers

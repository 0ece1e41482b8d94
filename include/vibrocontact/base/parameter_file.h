#pragma once

#include <vibrocontact/base/declared_parameters.h>
#include <vibrocontact/base/parameter_text.h>

#include <deal.II/base/parameter_handler.h>

#include <string>
#include <vector>

namespace vibrocontact
{
  /// A parameter file with the overrides of the command line, read in two passes:
  /// first only what decides which sections exist (the lists Bodies and Analyses, the type of a body), by
  /// list() and raw_value(); then, once everything is declared, all of it strictly by parse().
  ///
  /// Every error is one sentence: file:line (or the --set option), section, entry, what is wrong, the nearest
  /// valid names or the pattern in words. Values nan and inf are refused wherever numbers are expected.
  /// Sections are named by their path, e.g. "wheel/Material"; the top level is "".
  class ParameterFile
  {
  public:
    /// No file: everything has its default. where() then names section and entry alone.
    ParameterFile() = default;
    /// @param overrides "Section/Sub/Entry=value" as given with --set; the last one for an entry wins
    ParameterFile(const std::string &file_name, const std::string &bytes,
                  const std::vector<std::string> &overrides = {});

    /// First pass: value as written, or the default given; the file is not checked otherwise.
    std::string raw_value(const std::string &section, const std::string &entry,
                          const std::string &default_value = "") const;
    /// First pass: a list at the top level, separated by commas.
    std::vector<std::string> list(const std::string &entry) const;
    bool has_section(const std::string &path) const { return text.has_section(path); }
    /// Names of the sections at the top level, as in the file.
    std::vector<std::string> top_sections() const;

    /// Second pass: sets every value in the handler, which calls the actions of add_parameter().
    /// @return what is declared there, with the values as they are then
    /// @throws InputError on an unknown section or entry and on a value that does not match
    DeclaredParameters parse(dealii::ParameterHandler &prm) const;

    /// Where a value comes from: `file.prm:12, section Contact, entry "Friction coefficient"`, or
    /// `--set "Contact/Friction coefficient"`, or `file.prm, section ..., entry ... (not set, default)`.
    std::string where(const std::string &section, const std::string &entry) const;
    /// Where a section begins: `file.prm:12, section wheel`.
    std::string where_section(const std::string &path) const;
    /// A message that names entries by their paths ("wheel/Material/Density is -1: ...") with the options
    /// that set them, file and line in front, for checks that do not know the file. Messages that say where
    /// already are left alone.
    std::string located(const std::string &message) const;

    /// Of two entries of which one is to be given, named by their paths: if the file gives one and an option
    /// the other, drops the file's and returns its path; otherwise returns an empty text and changes
    /// nothing. Before parse().
    std::string prefer_option(const std::string &path_1, const std::string &path_2);

    /// Path of a file named in an entry: relative names count from the folder of the parameter file, or else
    /// from the working directory if there is one there. parse() applies it to entries of pattern FileName.
    std::string resolved_path(const std::string &name) const;
    const std::string &file_name() const { return text.file_name; }
    const std::string &bytes() const { return text.bytes; }

  private:
    ParameterText text;
    /// overrides, each entry once; line is unused
    std::vector<ParameterText::Entry> options;

    const ParameterText::Entry *find_option(const std::string &section, const std::string &entry) const;
    std::string location(const ParameterText::Entry &entry) const;
  };

  /// Reads the bytes of a file on rank 0 and gives them to all ranks.
  /// @throws InputError on every rank if it cannot be read
  std::string read_file_on_all_ranks(const std::string &file_name,
                                     const std::string &what = "parameter file");
} // namespace vibrocontact

#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/receptances/frequency_csv.h>
#include <vibrocontact/receptances/pole_file.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  namespace
  {
    const std::string real_end = "_residue_real_m_Ns", imag_end = "_residue_imag_m_Ns",
                      direct_end = "_direct_m_N";

    std::vector<std::string> pairs_of(const CsvTable &table)
    {
      std::vector<std::string> pairs;
      for (const std::string &name : table.names)
        if (const auto pair = without_end(name, real_end))
          pairs.push_back(*pair);
      for (const std::string &name : table.names)
      {
        bool understood = name == "frequency_Hz" || name == "damping_ratio" || name == "pole_real_1_s" ||
                          name == "pole_imag_1_s" || without_end(name, real_end);
        for (const std::string &end : {imag_end, direct_end})
          if (const auto pair = without_end(name, end))
            understood = understood || std::find(pairs.begin(), pairs.end(), *pair) != pairs.end();
        if (!understood)
          throw InputError("The table \"" + table.source + "\" has a column " + name +
                           ", which is none of a table of poles: pole_real_1_s, pole_imag_1_s, "
                           "<response>_<force>_residue_real_m_Ns, ..._residue_imag_m_Ns, ..._direct_m_N.");
      }
      if (pairs.empty())
        throw InputError("The table \"" + table.source +
                         "\" has no residues: name columns <response>_<force>_residue_real_m_Ns and _imag_.");
      return pairs;
    }

    /// Powers of it have to be numbers: those of the fastest pole up to the tenth.
    constexpr double largest_number = 1e15, slowest_pole = 1e-9, smallest_residue = 1e-30;

    void check_size(const CsvTable &table, const std::string &name, const std::size_t k)
    {
      const double value = table.column(name)[k];
      if (!(std::abs(value) <= largest_number))
        throw InputError("The table \"" + table.source + "\", line " + std::to_string(table.lines[k]) +
                         ", has " + name + " = " + number_text(value) + ", beyond " +
                         number_text(largest_number) + ": no body has such a pole; is the unit right?");
    }

    void check_pole(const CsvTable &table, const std::size_t k)
    {
      const double real = table.column("pole_real_1_s")[k], imag = table.column("pole_imag_1_s")[k];
      const std::string where =
          "The table \"" + table.source + "\", line " + std::to_string(table.lines[k]) + ", has ";
      if (!(real < 0))
        throw InputError(
            where + "an unstable pole, pole_real_1_s = " + number_text(real) +
            ": its motion does not decay; leave it out or give it damping (a negative real part).");
      if (std::hypot(real, imag) < slowest_pole)
        throw InputError(where + "a pole of " + number_text(std::hypot(real, imag)) + " 1/s, slower than " +
                         number_text(slowest_pole) + " 1/s: no body has such a pole; is the unit right?");
      check_size(table, "pole_real_1_s", k);
      check_size(table, "pole_imag_1_s", k);
    }

    /// Poles of bodies with a symmetry are double, with residues of their own.
    void check_given_once(const CsvTable &table, const PoleFit &fit)
    {
      const auto agree = [](const std::complex<double> &a, const std::complex<double> &b)
      { return std::abs(a - b) <= 1e-9 * std::abs(a); };
      for (std::size_t k = 0; k < fit.poles.size(); ++k)
        for (std::size_t i = 0; i < k; ++i)
        {
          const bool again = agree(fit.poles[k], fit.poles[i]);
          if (!again && !agree(fit.poles[k], std::conj(fit.poles[i])))
            continue;
          if (std::all_of(fit.residues.begin(), fit.residues.end(),
                          [&](const auto &residues)
                          { return agree(residues[k], again ? residues[i] : std::conj(residues[i])); }))
            throw InputError("The table \"" + table.source + "\", line " + std::to_string(table.lines[k]) +
                             ", has the pole and the residues of line " + std::to_string(table.lines[i]) +
                             " again, or their conjugates: give one of both, once.");
        }
    }

    double constant(const CsvTable &table, const std::string &name)
    {
      const std::vector<double> *const values = table.find(name);
      if (!values)
        return 0;
      for (std::size_t k = 0; k < values->size(); ++k)
        if ((*values)[k] != values->front())
          throw InputError("The table \"" + table.source + "\", line " + std::to_string(table.lines[k]) +
                           ", has another " + name +
                           " than the line before: it is one number, the same in all.");
      return values->front();
    }
  } // namespace

  PoleFile read_poles(const CsvTable &table)
  {
    PoleFile file;
    file.names.file_name = table.source;
    const std::vector<double> &real = table.column("pole_real_1_s"), &imag = table.column("pole_imag_1_s");
    if (real.empty())
      throw InputError("The table \"" + table.source + "\" has no poles: give one per line.");
    for (std::size_t k = 0; k < real.size(); ++k)
    {
      check_pole(table, k);
      file.fit.poles.emplace_back(real[k], imag[k]);
    }
    const std::vector<std::string> pairs = pairs_of(table);
    const auto points = split_pairs(table, pairs);
    for (std::size_t i = 0; i < pairs.size(); ++i)
    {
      FrequencyData::Entry entry;
      entry.response = file.names.label_index(points[i].first);
      entry.reference = file.names.label_index(points[i].second);
      file.names.entries.push_back(entry);
      const std::vector<double> &a = table.column(pairs[i] + real_end),
                                &b = table.column(pairs[i] + imag_end);
      file.fit.residues.emplace_back();
      for (std::size_t k = 0; k < a.size(); ++k)
      {
        check_size(table, pairs[i] + real_end, k);
        check_size(table, pairs[i] + imag_end, k);
      }
      for (std::size_t k = 0; k < a.size(); ++k)
        file.fit.residues.back().emplace_back(a[k], b[k]);
      double largest = 0;
      for (const std::complex<double> &residue : file.fit.residues.back())
        largest = std::max(largest, std::abs(residue));
      if (entry.response == entry.reference && largest < smallest_residue)
        throw InputError("The table \"" + table.source + "\" has no residue above " +
                         number_text(smallest_residue) + " m/(N s) in the columns " + pairs[i] +
                         "...: a force moves nothing there; is the unit right?");
      file.fit.direct.push_back(constant(table, pairs[i] + direct_end));
      if (!(std::abs(file.fit.direct.back()) <= largest_number))
        check_size(table, pairs[i] + direct_end, 0);
    }
    check_given_once(table, file.fit);
    const std::vector<std::string> &labels = file.names.labels;
    for (unsigned int i = 0; i < labels.size(); ++i)
      for (unsigned int j = 0; j < labels.size(); ++j)
        if (!file.names.find(i, j) && !file.names.find(j, i))
          throw InputError("The table \"" + table.source + "\" lacks the residues of " + labels[i] +
                           " under a force at " + labels[j] + ": contact needs every pair of its points.");
    return file;
  }

  Table poles_table(const PoleFit &fit, const FrequencyData &names, const std::string &title)
  {
    const bool direct =
        std::any_of(fit.direct.begin(), fit.direct.end(), [](const double value) { return value != 0; });
    std::vector<std::string> columns = {"frequency_Hz", "damping_ratio", "pole_real_1_s", "pole_imag_1_s"};
    for (unsigned int i = 0; i < names.entries.size(); ++i)
      for (const char *part : {"_residue_real_m_Ns", "_residue_imag_m_Ns"})
        columns.push_back(entry_name(names, i) + part);
    for (unsigned int i = 0; direct && i < names.entries.size(); ++i)
      columns.push_back(entry_name(names, i) + "_direct_m_N");
    Table table(
        columns,
        {title,
         "G = sum R/(j omega - lambda) + R*/(j omega - lambda*) + direct (the same in every line), response "
         "first, force second; of two conjugate poles one, a real pole carries half its residue"});
    for (unsigned int k = 0; k < fit.poles.size(); ++k)
    {
      const std::complex<double> pole = fit.poles[k];
      std::vector<Table::Cell> row = {std::abs(pole) / (2 * M_PI), -pole.real() / std::abs(pole), pole.real(),
                                      pole.imag()};
      for (const auto &residues : fit.residues)
      {
        row.push_back(residues[k].real());
        row.push_back(residues[k].imag());
      }
      for (unsigned int i = 0; direct && i < names.entries.size(); ++i)
        row.push_back(fit.direct[i]);
      table.add_row(row);
    }
    return table;
  }
} // namespace vibrocontact

#pragma once

#include <vibrocontact/contact/contact_problem.h>
#include <vibrocontact/contact/laws/normal_laws.h>

#include <string>

namespace vibrocontact
{
  /// Contact problems as HDF5 files in the layout of FCLIB's local problem (Acary, Bremond, Koziara,
  /// Perignon: FCLIB, a collection of discrete 3D frictional contact problems, INRIA RT-444, 2014), so that
  /// FCLIB and Siconos read ours and we read theirs. See doc/contact_problem_file.md for every name.
  ///
  ///   W r + V lambda + q = u,   V^T r + R lambda + s = 0,   u and r in Coulomb's law with mu
  ///
  /// W = A, r = R, u = y, q = b at the given approach; a given normal force is V = -e_n, lambda = approach,
  /// R = 0, s = the force. FCLIB counts components point by point (n, t1, t2), we component by component.
  /// What FCLIB has no place for (approach, normal law) stands in a group `vibrocontact` of its own.
  struct ContactFileOptions
  {
    /// numbers of W in single precision: half the size, and a slightly different problem
    bool single_precision = false;
    /// what the problem is and where it comes from
    std::string description;
  };

  /// contact points that a file can hold: the layout counts the entries of W by int
  constexpr unsigned int most_points_in_file = 10000;

  /// The matrix is written densely, compressed without loss. The file appears whole or not at all.
  /// @param solution written too unless it is empty
  /// @throws OutputError if the file cannot be written; InputError for more than most_points_in_file
  void write_contact_problem(const std::string &file_name, const ContactProblem &problem,
                             const ContactSolution &solution = {}, const ContactFileOptions &options = {});

  /// Files of other programs are read too: W by columns, rows or triplets; equality constraints if they are
  /// those of a given normal force. @param laws that the file may name
  /// @throws InputError if the file is missing, is laid out otherwise, or holds what is no contact problem
  ContactProblem read_contact_problem(const std::string &file_name,
                                      const std::vector<NormalLawEntry> &laws = normal_laws());

  /// The solution in a file, to be used as the start of a solver; empty if the file holds none.
  /// @throws InputError as above
  ContactSolution read_contact_solution(const std::string &file_name, const ContactProblem &problem);

  /// The problem on some of its points only; no other point may come into contact. Its operator is stored
  /// densely.
  ContactProblem restrict_to_points(const ContactProblem &problem, const std::vector<unsigned int> &points);
} // namespace vibrocontact

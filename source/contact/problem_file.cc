#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/hdf5_file.h>
#include <vibrocontact/base/memory.h>
#include <vibrocontact/base/utf8.h>
#include <vibrocontact/contact/problem_file.h>

#include <cmath>
#include <numeric>

namespace vibrocontact
{
  namespace
  {
    constexpr int most_rows = 3 * most_points_in_file;

    /// Numbers of another program may hold what no contact problem can.
    std::vector<double> finite_numbers(Hdf5Reader &file, const std::string &file_name,
                                       const std::string &path, const std::size_t size)
    {
      const std::vector<double> values = file.numbers(path, size);
      for (std::size_t i = 0; i < values.size(); ++i)
        if (!std::isfinite(values[i]))
          throw InputError("Value " + std::to_string(i) + " of '" + path + "' in the file '" + file_name +
                           "' is not a finite number; write the contact problem anew.");
      return values;
    }

    /// index in FCLIB's order of our row
    unsigned int theirs(const unsigned int row, const unsigned int n)
    {
      return 3 * (row % n) + row / n;
    }

    std::vector<double> reordered(const DenseVector &ours)
    {
      std::vector<double> values(ours.size());
      for (unsigned int row = 0; row < ours.size(); ++row)
        values[theirs(row, ours.size() / 3)] = ours[row];
      return values;
    }

    DenseVector reordered(const std::vector<double> &values)
    {
      DenseVector ours(values.size());
      for (unsigned int row = 0; row < ours.size(); ++row)
        ours[row] = values[theirs(row, ours.size() / 3)];
      return ours;
    }

    /// a matrix by compressed columns
    void write_matrix(Hdf5Writer &file, const std::string &path, const DenseMatrix &matrix, const bool single)
    {
      const unsigned int rows = matrix.m(), columns = matrix.n();
      std::vector<int> p(columns + 1), index(std::size_t(rows) * columns);
      for (unsigned int column = 0; column <= columns; ++column)
        p[column] = column * rows;
      for (std::size_t k = 0; k < index.size(); ++k)
        index[k] = k % rows;
      file.write(path + "/nzmax", int(index.size()));
      file.write(path + "/m", int(rows));
      file.write(path + "/n", int(columns));
      file.write(path + "/nz", -1);
      file.write(path + "/p", p, {false, true});
      file.write(path + "/i", index, {false, true});
      const double *const first = &matrix(0, 0);
      file.write(path + "/x", std::vector<double>(first, first + index.size()), {single, true});
    }

    /// The rows of a or l, one on every gap if they are not given.
    DenseVector rows_of(const DenseVector &given, const unsigned int n)
    {
      DenseVector rows(3 * n);
      for (unsigned int row = 0; row < 3 * n; ++row)
        rows[row] = given.size() > 0 ? given[row] : row < n ? 1. : 0.;
      return rows;
    }

    /// Group of a law: the first of a file, those of further contacts behind it.
    std::string law_group(const unsigned int number)
    {
      return "/vibrocontact/normal_law" + (number == 0 ? "" : "_" + std::to_string(number)) + "/";
    }

    /// The laws of the points, and where there are several the number of each point's.
    void write_laws(Hdf5Writer &file, const ContactProblem &problem)
    {
      std::vector<const NormalLaw *> laws;
      std::vector<int> number;
      for (unsigned int i = 0; i < problem.n_points(); ++i)
      {
        const NormalLaw *const own = &problem.normal_law[i];
        if (laws.empty() || laws.back() != own)
        {
          const LawDescription law = own->description();
          file.write(law_group(laws.size()) + "name", law.name);
          if (!law.numbers.empty())
            file.write(law_group(laws.size()) + "numbers", law.numbers);
          laws.push_back(own);
        }
        number.push_back(laws.size() - 1);
      }
      if (laws.size() > 1)
        file.write("/vibrocontact/law_of_point", number, {false, true});
    }

    /// of a normal law; files of earlier versions give an amplitude and an exponent, of the linear spring k and 1
    std::vector<double> law_numbers(Hdf5Reader &file, const std::string &file_name, const std::string &law,
                                    const std::vector<NormalLawEntry> &laws)
    {
      if (file.has(law + "numbers"))
        return finite_numbers(file, file_name, law + "numbers", 0);
      if (!file.has(law + "amplitude") ||
          find_normal_law(as_utf8(file.text(law + "name")), laws).parameters.empty())
        return {};
      return {finite_numbers(file, file_name, law + "amplitude", 1).front(),
              finite_numbers(file, file_name, law + "exponent", 1).front()};
    }

    PointLaws<NormalLaw> read_laws(Hdf5Reader &file, const std::string &file_name, const unsigned int n,
                                   const std::vector<NormalLawEntry> &laws)
    {
      const auto law = [&](const unsigned int number)
      {
        const std::string group = law_group(number);
        return create_normal_law(as_utf8(file.text(group + "name")),
                                 law_numbers(file, file_name, group, laws), laws);
      };
      if (!file.has("/vibrocontact/law_of_point"))
        return law(0);
      std::vector<std::pair<std::shared_ptr<const NormalLaw>, unsigned int>> all;
      for (const int number : file.integers("/vibrocontact/law_of_point", n))
      {
        if (number != int(all.size()) && number + 1 != int(all.size()))
          throw InputError("The laws of the points in the file '" + file_name +
                           "' (/vibrocontact/law_of_point) do not follow each other from 0 on; write the "
                           "contact problem anew.");
        if (number == int(all.size()))
          all.emplace_back(law(number), 0);
        ++all.back().second;
      }
      return PointLaws<NormalLaw>::of_contacts(all);
    }

    DenseMatrix read_matrix(Hdf5Reader &file, const std::string &file_name, const std::string &path)
    {
      const int m = file.integer(path + "/m"), n = file.integer(path + "/n"), nz = file.integer(path + "/nz"),
                nzmax = file.integer(path + "/nzmax");
      const auto refuse = [&](const std::string &what)
      {
        throw InputError("The matrix '" + path + "' in the file '" + file_name + "' " + what +
                         "; write it as FCLIB does (doc/contact_problem_file.md).");
      };
      if (m < 1 || n < 1 || m > most_rows || n > most_rows || nz < -2 || nzmax < 0)
        refuse("has a size or a kind (m, n, nz, nzmax) that makes no sense");
      if (nz > nzmax)
        refuse("has more triplets (nz) than places for them (nzmax)");
      const std::size_t entries = nz >= 0 ? nz : nzmax;
      // room is made for all rows and columns, twice in two orders: those of a problem have an entry for every point at least
      if (std::size_t(std::max(m, n)) > 3 * entries + 3)
        refuse("has " + std::to_string(m) + " rows and " + std::to_string(n) + " columns but only " +
               std::to_string(entries) + " entries");
      const double bytes = 2. * m * n * sizeof(double) + double(entries) * (sizeof(double) + sizeof(int));
      const MemoryLeft left = memory_left();
      if (bytes > left.bytes)
        throw MachineError("The matrix '" + path + "' in the file '" + file_name + "', of " +
                           std::to_string(m) + " rows and " + std::to_string(n) + " columns, needs about " +
                           bytes_text(bytes) + ", but " + left.limit + " leaves " + bytes_text(left.bytes) +
                           "; take a problem of fewer points or a larger machine.");
      const std::vector<int> p = file.integers(path + "/p", nz >= 0 ? entries : (nz == -1 ? n : m) + 1);
      const std::vector<int> index = file.integers(path + "/i", entries);
      const std::vector<double> x = finite_numbers(file, file_name, path + "/x", nzmax);
      DenseMatrix matrix(m, n);
      const auto add = [&](const int row, const int column, const double value)
      {
        if (row < 0 || row >= m || column < 0 || column >= n)
          refuse("has an index outside its size");
        matrix(row, column) += value;
      };
      if (nz >= 0)
        for (std::size_t k = 0; k < entries; ++k)
          add(p[k], index[k], x[k]);
      else
        for (std::size_t line = 0; line + 1 < p.size(); ++line)
        {
          if (p[line] < 0 || p[line + 1] < p[line] || p[line + 1] > nzmax)
            refuse("has pointers that do not increase up to nzmax");
          for (int k = p[line]; k < p[line + 1]; ++k)
            nz == -1 ? add(index[k], line, x[k]) : add(line, index[k], x[k]);
        }
      return matrix;
    }

    void check_three_rows(const ContactProblem &problem)
    {
      AssertThrow(problem.n_components() == 3 && problem.b.size() == problem.n_rows(),
                  dealii::ExcMessage("A contact problem in a file has three rows for each point."));
    }
  } // namespace

  void write_contact_problem(const std::string &file_name, const ContactProblem &problem,
                             const ContactSolution &solution, const ContactFileOptions &options)
  {
    const unsigned int n = problem.n_points();
    check_three_rows(problem);
    if (n > most_points_in_file)
      throw InputError("A contact problem of " + std::to_string(n) + " points cannot be stored, at most " +
                       std::to_string(most_points_in_file) +
                       " can: set Output/Contact problems = false or enlarge Contact/Grid spacing.");
    Hdf5Writer file(file_name);
    std::vector<unsigned int> all(n);
    std::iota(all.begin(), all.end(), 0);
    DenseMatrix A, W(3 * n, 3 * n);
    problem.A->extract(all, A);
    for (unsigned int column = 0; column < 3 * n; ++column)
      for (unsigned int row = 0; row < 3 * n; ++row)
        W(theirs(row, n), theirs(column, n)) = A(row, column);
    const DenseVector usual = rows_of({}, n), by_approach = rows_of(problem.by_approach, n),
                      to_force = rows_of(problem.to_force, n);
    DenseVector q = problem.b;
    if (!problem.force_given())
      q.add(-problem.approach, by_approach);

    const std::string local = "/fclib_local";
    file.write(local + "/spacedim", 3);
    write_matrix(file, local + "/W", W, options.single_precision);
    if (problem.force_given())
    {
      DenseMatrix V(3 * n, 1), R(1, 1);
      for (unsigned int row = 0; row < 3 * n; ++row)
        V(theirs(row, n), 0) = -by_approach[row];
      write_matrix(file, local + "/V", V, false);
      write_matrix(file, local + "/R", R, false);
      file.write(local + "/vectors/s", problem.normal_force);
    }
    file.write(local + "/vectors/q", reordered(q), {false, true});
    file.write(local + "/vectors/mu", problem.mu, {false, true});
    file.write(local + "/info/title", problem.title);
    file.write(local + "/info/description", options.description);
    file.write(local + "/info/math_info",
               std::string("W is dense and not symmetric; u is the gap [m] and the slip velocity [m/s]"));
    file.write("/vibrocontact/approach", problem.approach);
    if (by_approach != usual || to_force != usual)
    {
      file.write("/vibrocontact/by_approach", reordered(by_approach), {false, true});
      file.write("/vibrocontact/to_force", reordered(to_force), {false, true});
    }
    write_laws(file, problem);
    if (!solution.empty())
    {
      file.write("/solution/u", reordered(solution.y), {false, true});
      file.write("/solution/r", reordered(solution.R), {false, true});
      if (problem.force_given())
        file.write("/solution/l", solution.approach);
    }
    file.finish();
  }

  ContactProblem read_contact_problem(const std::string &file_name, const std::vector<NormalLawEntry> &laws)
  {
    Hdf5Reader file(file_name);
    const auto refuse = [&](const std::string &what)
    {
      throw InputError("The contact problem in the file '" + file_name + "' " + what +
                       "; see doc/contact_problem_file.md for what is read.");
    };
    const std::string local = "/fclib_local";
    if (file.integer(local + "/spacedim") != 3)
      refuse("is not three-dimensional (spacedim 3)");
    const DenseMatrix W = read_matrix(file, file_name, local + "/W");
    if (W.m() != W.n() || W.m() % 3 != 0)
      refuse("has a matrix W that is not square with three rows per point");
    const unsigned int n = W.m() / 3;
    DenseMatrix A(3 * n);
    for (unsigned int column = 0; column < 3 * n; ++column)
      for (unsigned int row = 0; row < 3 * n; ++row)
        A(row, column) = W(theirs(row, n), theirs(column, n));
    for (unsigned int component = 0; component < 3; ++component)
    {
      double sum = 0;
      for (unsigned int i = 0; i < n; ++i)
        sum += A(component * n + i, component * n + i);
      if (!(sum > 0))
        refuse("has a matrix W whose diagonal is not positive");
    }

    ContactProblem problem;
    problem.A = std::make_shared<DenseContactOperator>(std::move(A));
    if (file.has(local + "/info/title"))
      problem.title = as_utf8(file.text(local + "/info/title"));
    problem.b = reordered(finite_numbers(file, file_name, local + "/vectors/q", 3 * n));
    problem.mu = finite_numbers(file, file_name, local + "/vectors/mu", n);
    for (const double mu : problem.mu)
      if (mu < 0)
        refuse("has a negative friction coefficient");
    if (file.has("/vibrocontact/approach"))
      problem.approach = finite_numbers(file, file_name, "/vibrocontact/approach", 1).front();
    if (file.has("/vibrocontact/normal_law/name"))
      problem.normal_law = read_laws(file, file_name, n, laws);
    if (file.has("/vibrocontact/by_approach"))
    {
      problem.by_approach = reordered(finite_numbers(file, file_name, "/vibrocontact/by_approach", 3 * n));
      problem.to_force = reordered(finite_numbers(file, file_name, "/vibrocontact/to_force", 3 * n));
    }
    const DenseVector by_approach = rows_of(problem.by_approach, n);
    if (file.has(local + "/V"))
    {
      const DenseMatrix V = read_matrix(file, file_name, local + "/V"),
                        R = read_matrix(file, file_name, local + "/R");
      bool force = V.m() == 3 * n && V.n() == 1 && R.m() == 1 && R.n() == 1 && R(0, 0) == 0;
      for (unsigned int row = 0; force && row < 3 * n; ++row)
        force = V(theirs(row, n), 0) == -by_approach[row];
      if (!force)
        refuse("has equality constraints other than a given normal force (V = -1 on every gap, or what "
               "/vibrocontact/by_approach says, R = 0)");
      problem.normal_force = finite_numbers(file, file_name, local + "/vectors/s", 1).front();
      if (!(problem.normal_force > 0))
        refuse("has a normal force s that is not positive");
    }
    else
      problem.b.add(problem.approach, by_approach);
    return problem;
  }

  ContactSolution read_contact_solution(const std::string &file_name, const ContactProblem &problem)
  {
    Hdf5Reader file(file_name);
    ContactSolution solution;
    if (!file.has("/solution/r"))
      return solution;
    const unsigned int size = 3 * problem.n_points();
    solution.R = reordered(finite_numbers(file, file_name, "/solution/r", size));
    solution.approach =
        problem.force_given() ? finite_numbers(file, file_name, "/solution/l", 1).front() : problem.approach;
    contact_response(problem, solution.R, solution.approach, solution.y);
    DenseVector projected;
    solution.residual = ContactResidual(problem).evaluate(solution.R, solution.y, projected, solution.status);
    return solution;
  }

  ContactProblem restrict_to_points(const ContactProblem &problem, const std::vector<unsigned int> &points)
  {
    const unsigned int n = problem.n_points(), m = points.size();
    check_three_rows(problem);
    ContactProblem part = problem;
    DenseMatrix A;
    problem.A->extract(points, A);
    part.A = std::make_shared<DenseContactOperator>(std::move(A));
    const auto restrict_rows = [&](const DenseVector &from, DenseVector &to)
    {
      to.reinit(3 * m);
      for (unsigned int c = 0; c < 3; ++c)
        for (unsigned int k = 0; k < m; ++k)
          to[c * m + k] = from[c * n + points[k]];
    };
    restrict_rows(problem.b, part.b);
    if (problem.by_approach.size() > 0)
      restrict_rows(problem.by_approach, part.by_approach);
    if (problem.to_force.size() > 0)
      restrict_rows(problem.to_force, part.to_force);
    part.mu.resize(m);
    for (unsigned int k = 0; k < m; ++k)
      part.mu[k] = problem.mu[points[k]];
    part.normal_law = problem.normal_law.at(points);
    part.friction_law = problem.friction_law.at(points);
    return part;
  }
} // namespace vibrocontact

#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/contact/problem_file.h>

#include <hdf5.h>

#include <cmath>
#include <cstdio>
#include <numeric>

namespace vibrocontact
{
  namespace
  {
    /// An HDF5 file that is closed at the end of the scope and whose errors are ours to report.
    class File
    {
    public:
      File(const hid_t id, const std::string &name) : id(id), name(name) {}
      ~File()
      {
        if (id >= 0)
          H5Fclose(id);
      }
      File(const File &) = delete;
      File &operator=(const File &) = delete;

      /// all sets of numbers have one index
      void write(const std::string &path, const hid_t memory_type, const hid_t file_type, const void *data,
                 const hsize_t size)
      {
        const hid_t links = H5Pcreate(H5P_LINK_CREATE), creation = H5Pcreate(H5P_DATASET_CREATE);
        H5Pset_create_intermediate_group(links, 1);
        if (size > 1000)
        {
          const hsize_t chunk = std::min<hsize_t>(size, 1u << 16);
          H5Pset_chunk(creation, 1, &chunk);
          H5Pset_shuffle(creation);
          H5Pset_deflate(creation, 6);
        }
        const hid_t space = H5Screate_simple(1, &size, nullptr);
        const hid_t set = H5Dcreate2(id, path.c_str(), file_type, space, links, creation, H5P_DEFAULT);
        const herr_t error = set < 0 ? -1 : H5Dwrite(set, memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data);
        if (set >= 0)
          H5Dclose(set);
        H5Sclose(space);
        H5Pclose(creation);
        H5Pclose(links);
        if (error < 0)
          throw InputError("Cannot write '" + path + "' to the file '" + name + "'; is the disk full?");
      }
      void write(const std::string &path, const std::vector<int> &values)
      {
        write(path, H5T_NATIVE_INT, H5T_STD_I32LE, values.data(), values.size());
      }
      void write(const std::string &path, const int value) { write(path, std::vector<int>{value}); }
      void write(const std::string &path, const std::vector<double> &values, const bool single = false)
      {
        write(path, H5T_NATIVE_DOUBLE, single ? H5T_IEEE_F32LE : H5T_IEEE_F64LE, values.data(),
              values.size());
      }
      void write(const std::string &path, const std::string &text)
      {
        const hid_t links = H5Pcreate(H5P_LINK_CREATE), type = H5Tcopy(H5T_C_S1);
        H5Pset_create_intermediate_group(links, 1);
        H5Tset_size(type, text.size() + 1);
        const hid_t space = H5Screate(H5S_SCALAR);
        const hid_t set = H5Dcreate2(id, path.c_str(), type, space, links, H5P_DEFAULT, H5P_DEFAULT);
        H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.c_str());
        H5Dclose(set);
        H5Sclose(space);
        H5Tclose(type);
        H5Pclose(links);
      }

      bool has(const std::string &path) const
      {
        for (std::size_t slash = path.find('/', 1); slash != std::string::npos;
             slash = path.find('/', slash + 1))
          if (H5Lexists(id, path.substr(0, slash).c_str(), H5P_DEFAULT) <= 0)
            return false;
        return H5Lexists(id, path.c_str(), H5P_DEFAULT) > 0;
      }

      /// @param size expected number of values, or 0 for any
      template <typename T>
      std::vector<T> read(const std::string &path, const hid_t type, const std::size_t size) const
      {
        const hid_t set = has(path) ? H5Dopen2(id, path.c_str(), H5P_DEFAULT) : -1;
        if (set < 0)
          throw InputError("The file '" + name + "' has no '" + path +
                           "'; a contact problem needs the layout of FCLIB's local problems.");
        const hid_t space = H5Dget_space(set);
        std::vector<T> values(H5Sget_simple_extent_npoints(space));
        const bool fits = size == 0 || values.size() == size;
        const herr_t error =
            fits && !values.empty() ? H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) : 0;
        H5Sclose(space);
        H5Dclose(set);
        if (!fits)
          throw InputError("'" + path + "' in the file '" + name + "' has " + std::to_string(values.size()) +
                           " values instead of " + std::to_string(size) + ".");
        if (error < 0)
          throw InputError("'" + path + "' in the file '" + name + "' cannot be read as numbers.");
        return values;
      }
      std::vector<double> numbers(const std::string &path, const std::size_t size) const
      {
        std::vector<double> values = read<double>(path, H5T_NATIVE_DOUBLE, size);
        for (std::size_t i = 0; i < values.size(); ++i)
          if (!std::isfinite(values[i]))
            throw InputError("Value " + std::to_string(i) + " of '" + path + "' in the file '" + name +
                             "' is not a finite number.");
        return values;
      }
      int integer(const std::string &path) const { return read<int>(path, H5T_NATIVE_INT, 1).front(); }
      std::string text(const std::string &path) const
      {
        const hid_t set = has(path) ? H5Dopen2(id, path.c_str(), H5P_DEFAULT) : -1;
        if (set < 0)
          return {};
        const hid_t type = H5Dget_type(set);
        std::string value(H5Tget_class(type) == H5T_STRING ? H5Tget_size(type) : 0, '\0');
        if (H5Tis_variable_str(type) > 0 ||
            (!value.empty() && H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, value.data()) < 0))
          value.clear();
        H5Tclose(type);
        H5Dclose(set);
        return value.c_str();
      }

    private:
      const hid_t id;
      const std::string name;
    };

    struct Silence
    {
      Silence()
      {
        H5Eget_auto2(H5E_DEFAULT, &function, &data);
        H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
      }
      ~Silence() { H5Eset_auto2(H5E_DEFAULT, function, data); }
      H5E_auto2_t function;
      void *data;
    };

    hid_t open(const std::string &file_name)
    {
      const hid_t id = H5Fopen(file_name.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
      if (id < 0)
        throw InputError("Cannot open the contact problem '" + file_name +
                         "': it is missing or no HDF5 file.");
      return id;
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
    void write_matrix(File &file, const std::string &path, const DenseMatrix &matrix, const bool single)
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
      file.write(path + "/p", p);
      file.write(path + "/i", index);
      const double *const first = &matrix(0, 0);
      file.write(path + "/x", std::vector<double>(first, first + index.size()), single);
    }

    DenseMatrix read_matrix(const File &file, const std::string &file_name, const std::string &path)
    {
      const int m = file.integer(path + "/m"), n = file.integer(path + "/n"), nz = file.integer(path + "/nz"),
                nzmax = file.integer(path + "/nzmax");
      const auto refuse = [&](const std::string &what)
      { throw InputError("The matrix '" + path + "' in the file '" + file_name + "' " + what + "."); };
      if (m < 1 || n < 1 || m > 30000 || n > 30000 || nz < -2 || nzmax < 0)
        refuse("has a size or a kind (m, n, nz, nzmax) that makes no sense");
      const std::size_t entries = nz >= 0 ? nz : nzmax;
      const std::vector<int> p =
          file.read<int>(path + "/p", H5T_NATIVE_INT, nz >= 0 ? entries : (nz == -1 ? n : m) + 1);
      const std::vector<int> index = file.read<int>(path + "/i", H5T_NATIVE_INT, entries);
      const std::vector<double> x = file.numbers(path + "/x", nzmax);
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
  } // namespace

  void write_contact_problem(const std::string &file_name, const ContactProblem &problem,
                             const ContactSolution &solution, const ContactFileOptions &options)
  {
    const Silence silence;
    const unsigned int n = problem.n_points();
    const std::string part = file_name + ".part";
    {
      const hid_t id = H5Fcreate(part.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
      if (id < 0)
        throw InputError("Cannot write the file '" + file_name + "'; check the folder and its rights.");
      File file(id, file_name);
      std::vector<unsigned int> all(n);
      std::iota(all.begin(), all.end(), 0);
      DenseMatrix A, W(3 * n, 3 * n);
      problem.A->extract(all, A);
      for (unsigned int column = 0; column < 3 * n; ++column)
        for (unsigned int row = 0; row < 3 * n; ++row)
          W(theirs(row, n), theirs(column, n)) = A(row, column);
      DenseVector q = problem.b;
      if (!problem.force_given())
        for (unsigned int i = 0; i < n; ++i)
          q[i] -= problem.approach;

      const std::string local = "/fclib_local";
      file.write(local + "/spacedim", 3);
      write_matrix(file, local + "/W", W, options.single_precision);
      if (problem.force_given())
      {
        DenseMatrix V(3 * n, 1), R(1, 1);
        for (unsigned int i = 0; i < n; ++i)
          V(3 * i, 0) = -1;
        write_matrix(file, local + "/V", V, false);
        write_matrix(file, local + "/R", R, false);
        file.write(local + "/vectors/s", std::vector<double>{problem.normal_force});
      }
      file.write(local + "/vectors/q", reordered(q));
      file.write(local + "/vectors/mu", problem.mu);
      file.write(local + "/info/title", problem.title);
      file.write(local + "/info/description", options.description);
      file.write(local + "/info/math_info",
                 std::string("W is dense and not symmetric; u is the gap [m] and the slip velocity [m/s]"));
      const NormalLaw::Description law = problem.normal_law->description();
      file.write("/vibrocontact/approach", std::vector<double>{problem.approach});
      file.write("/vibrocontact/normal_law/name", law.name);
      file.write("/vibrocontact/normal_law/amplitude", std::vector<double>{law.amplitude});
      file.write("/vibrocontact/normal_law/exponent", std::vector<double>{law.exponent});
      if (!solution.empty())
      {
        file.write("/solution/u", reordered(solution.y));
        file.write("/solution/r", reordered(solution.R));
        if (problem.force_given())
          file.write("/solution/l", std::vector<double>{solution.approach});
      }
    }
    if (std::rename(part.c_str(), file_name.c_str()) != 0)
      throw InputError("Cannot write the file '" + file_name + "'; check the folder and its rights.");
  }

  ContactProblem read_contact_problem(const std::string &file_name)
  {
    const Silence silence;
    const File file(open(file_name), file_name);
    const auto refuse = [&](const std::string &what)
    { throw InputError("The contact problem in the file '" + file_name + "' " + what + "."); };
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
    problem.title = file.text(local + "/info/title");
    problem.b = reordered(file.numbers(local + "/vectors/q", 3 * n));
    problem.mu = file.numbers(local + "/vectors/mu", n);
    for (const double mu : problem.mu)
      if (mu < 0)
        refuse("has a negative friction coefficient");
    if (file.has("/vibrocontact/approach"))
      problem.approach = file.numbers("/vibrocontact/approach", 1).front();
    if (file.has("/vibrocontact/normal_law/name"))
      problem.normal_law = create_normal_law(file.text("/vibrocontact/normal_law/name"),
                                             file.numbers("/vibrocontact/normal_law/amplitude", 1).front(),
                                             file.numbers("/vibrocontact/normal_law/exponent", 1).front());
    if (file.has(local + "/V"))
    {
      const DenseMatrix V = read_matrix(file, file_name, local + "/V"),
                        R = read_matrix(file, file_name, local + "/R");
      bool force = V.m() == 3 * n && V.n() == 1 && R.m() == 1 && R.n() == 1 && R(0, 0) == 0;
      for (unsigned int row = 0; force && row < 3 * n; ++row)
        force = V(row, 0) == (row % 3 == 0 ? -1 : 0);
      if (!force)
        refuse("has equality constraints other than a given normal force (V = -1 on every gap, R = 0)");
      problem.normal_force = file.numbers(local + "/vectors/s", 1).front();
      if (!(problem.normal_force > 0))
        refuse("has a normal force s that is not positive");
    }
    else
      for (unsigned int i = 0; i < n; ++i)
        problem.b[i] += problem.approach;
    return problem;
  }

  ContactSolution read_contact_solution(const std::string &file_name, const ContactProblem &problem)
  {
    const Silence silence;
    const File file(open(file_name), file_name);
    ContactSolution solution;
    if (!file.has("/solution/r"))
      return solution;
    const unsigned int size = 3 * problem.n_points();
    solution.R = reordered(file.numbers("/solution/r", size));
    solution.approach = problem.force_given() ? file.numbers("/solution/l", 1).front() : problem.approach;
    contact_response(problem, solution.R, solution.approach, solution.y);
    DenseVector projected;
    solution.residual = ContactResidual(problem).evaluate(solution.R, solution.y, projected, solution.status);
    return solution;
  }

  ContactProblem restrict_to_points(const ContactProblem &problem, const std::vector<unsigned int> &points)
  {
    const unsigned int n = problem.n_points(), m = points.size();
    ContactProblem part = problem;
    DenseMatrix A;
    problem.A->extract(points, A);
    part.A = std::make_shared<DenseContactOperator>(std::move(A));
    part.b.reinit(3 * m);
    part.mu.resize(m);
    for (unsigned int k = 0; k < m; ++k)
    {
      part.mu[k] = problem.mu[points[k]];
      for (unsigned int c = 0; c < 3; ++c)
        part.b[c * m + k] = problem.b[c * n + points[k]];
    }
    return part;
  }
} // namespace vibrocontact

#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/hdf5_file.h>

#include <hdf5.h>

#include <cstdio>
#include <stdexcept>

namespace vibrocontact
{
  namespace
  {
    constexpr unsigned long long checksum_start = 1469598103934665603ull;

    // FNV on words of eight bytes: 10 ms for a compliance of 1,800 rows.
    void add_to(unsigned long long &checksum, const double *values, const std::size_t n)
    {
      const auto *words = reinterpret_cast<const unsigned char *>(values);
      for (std::size_t i = 0; i < n; ++i)
      {
        unsigned long long word = 0;
        std::copy_n(words + 8 * i, 8, reinterpret_cast<unsigned char *>(&word));
        checksum = (checksum ^ word) * 1099511628211ull;
      }
    }

    void add_to(unsigned long long &checksum, const std::string &text)
    {
      for (const unsigned char c : text)
        checksum = (checksum ^ c) * 1099511628211ull;
    }

    // HDF5 prints its own stack of errors otherwise.
    void silence()
    {
      H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    }

    void write_array(const hid_t file, const std::string &name, const hid_t type, const void *data,
                     const int rank, const hsize_t *sizes)
    {
      const hid_t space = H5Screate_simple(rank, sizes, nullptr);
      const hid_t set = H5Dcreate2(file, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
      const herr_t error = set < 0 ? -1 : H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data);
      H5Dclose(set);
      H5Sclose(space);
      if (error < 0)
        throw OutputError("Cannot write '" + name + "' to an HDF5 file; is the disk full?");
    }

    // Sizes of a set, then its data.
    template <typename T>
    std::vector<T> read_array(const hid_t file, const std::string &file_name, const std::string &name,
                              const hid_t type, std::vector<hsize_t> &sizes)
    {
      const hid_t set = H5Dopen2(file, name.c_str(), H5P_DEFAULT);
      if (set < 0)
        throw std::runtime_error("'" + file_name + "' has no '" + name + "'");
      const hid_t space = H5Dget_space(set);
      sizes.resize(H5Sget_simple_extent_ndims(space));
      H5Sget_simple_extent_dims(space, sizes.data(), nullptr);
      std::vector<T> data(H5Sget_simple_extent_npoints(space));
      const herr_t error = data.empty() ? 0 : H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data.data());
      H5Sclose(space);
      H5Dclose(set);
      if (error < 0)
        throw std::runtime_error("'" + name + "' in '" + file_name + "' cannot be read");
      return data;
    }
  } // namespace

  Hdf5Writer::Hdf5Writer(const std::string &file_name) : file_name(file_name), checksum(checksum_start)
  {
    silence();
    file = H5Fcreate((file_name + ".part").c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    if (file < 0)
      throw OutputError("Cannot write the file '" + file_name + ".part'; check the folder and its rights.");
  }

  Hdf5Writer::~Hdf5Writer()
  {
    if (file >= 0)
    {
      H5Fclose(file);
      std::remove((file_name + ".part").c_str());
    }
  }

  void Hdf5Writer::write(const std::string &name, const std::vector<double> &values)
  {
    const hsize_t size = values.size();
    write_array(file, name, H5T_NATIVE_DOUBLE, values.data(), 1, &size);
    add_to(checksum, values.data(), values.size());
  }

  void Hdf5Writer::write(const std::string &name, const DenseMatrix &matrix)
  {
    // HDF5 counts rows first: the file holds the transposed, column by column, so that columns are
    // contiguous.
    const hsize_t sizes[2] = {matrix.n(), matrix.m()};
    const double *const data = matrix.m() * matrix.n() > 0 ? &matrix(0, 0) : nullptr;
    write_array(file, name, H5T_NATIVE_DOUBLE, data, 2, sizes);
    add_to(checksum, data, sizes[0] * sizes[1]);
  }

  void Hdf5Writer::write(const std::string &name, const std::string &text)
  {
    const hsize_t size = text.size();
    write_array(file, name, H5T_NATIVE_CHAR, text.data(), 1, &size);
    add_to(checksum, text);
  }

  void Hdf5Writer::finish()
  {
    const hid_t space = H5Screate(H5S_SCALAR);
    const hid_t attribute = H5Acreate2(file, "checksum", H5T_NATIVE_ULLONG, space, H5P_DEFAULT, H5P_DEFAULT);
    const herr_t written = H5Awrite(attribute, H5T_NATIVE_ULLONG, &checksum);
    H5Aclose(attribute);
    H5Sclose(space);
    const herr_t closed = H5Fclose(file);
    file = -1;
    if (written < 0 || closed < 0 || std::rename((file_name + ".part").c_str(), file_name.c_str()) != 0)
    {
      std::remove((file_name + ".part").c_str());
      throw OutputError("Cannot write the file '" + file_name + "'; is the disk full?");
    }
  }

  Hdf5Reader::Hdf5Reader(const std::string &file_name) : file_name(file_name), checksum(checksum_start)
  {
    silence();
    file = H5Fopen(file_name.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    if (file < 0)
      throw std::runtime_error("'" + file_name + "' is not a readable HDF5 file");
  }

  Hdf5Reader::~Hdf5Reader()
  {
    H5Fclose(file);
  }

  std::vector<double> Hdf5Reader::vector(const std::string &name)
  {
    std::vector<hsize_t> sizes;
    const auto values = read_array<double>(file, file_name, name, H5T_NATIVE_DOUBLE, sizes);
    add_to(checksum, values.data(), values.size());
    return values;
  }

  DenseMatrix Hdf5Reader::matrix(const std::string &name)
  {
    std::vector<hsize_t> sizes;
    const auto values = read_array<double>(file, file_name, name, H5T_NATIVE_DOUBLE, sizes);
    if (sizes.size() != 2)
      throw std::runtime_error("'" + name + "' in '" + file_name + "' is no matrix");
    add_to(checksum, values.data(), values.size());
    DenseMatrix result(sizes[1], sizes[0]);
    if (!values.empty())
      std::copy(values.begin(), values.end(), &result(0, 0));
    return result;
  }

  std::string Hdf5Reader::text(const std::string &name)
  {
    std::vector<hsize_t> sizes;
    const auto bytes = read_array<char>(file, file_name, name, H5T_NATIVE_CHAR, sizes);
    const std::string result(bytes.begin(), bytes.end());
    add_to(checksum, result);
    return result;
  }

  void Hdf5Reader::verify() const
  {
    unsigned long long written = 0;
    const hid_t attribute = H5Aopen(file, "checksum", H5P_DEFAULT);
    const herr_t error = attribute < 0 ? -1 : H5Aread(attribute, H5T_NATIVE_ULLONG, &written);
    H5Aclose(attribute);
    if (error < 0 || written != checksum)
      throw std::runtime_error("the contents of '" + file_name + "' are damaged");
  }
} // namespace vibrocontact

#include <vibrocontact/base/blas.h>
#include <vibrocontact/base/data_directory.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/fault.h>
#include <vibrocontact/base/singleton_start.h>
#include <vibrocontact/run/program.h>
#include <vibrocontact/run/run.h>

#include <deal.II/base/mpi.h>

#include <clocale>

namespace vibrocontact
{
  int run_program(const Tables &tables, int argc, char **argv, const std::string &data_directory)
  {
    std::setlocale(LC_ALL, "C");
    const SingletonStart start;
    // PETSc would take --help and --version for its own: it gets no arguments.
    int n_arguments = 1;
    dealii::Utilities::MPI::MPI_InitFinalize mpi(n_arguments, argv, 1);
    dealii::deal_II_exceptions::disable_abort_on_exception();
    prepare_blas();
    set_data_directory(data_directory);
    try
    {
      return run(tables, read_command_line(argc, argv));
    }
    catch (const InputError &error)
    {
      return leave_together(1, error.what());
    }
    catch (const ConvergenceError &error)
    {
      return leave_together(2, error.what());
    }
    catch (const OutputError &error)
    {
      return leave_together(3, error.what());
    }
    catch (const std::exception &error)
    {
      return leave_together(3, std::string("fault of the program: ") + error.what());
    }
  }
} // namespace vibrocontact

#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/failure.h>
#include <vibrocontact/base/memory.h>

namespace vibrocontact
{
  Failure failure_of(const std::function<void()> &action)
  {
    try
    {
      action();
    }
    catch (const MachineError &error)
    {
      return {Failure::Kind::machine, error.what()};
    }
    catch (const InputError &error)
    {
      return {Failure::Kind::input, error.what()};
    }
    catch (const OutputError &error)
    {
      return {Failure::Kind::output, error.what()};
    }
    catch (const ConvergenceError &error)
    {
      return {Failure::Kind::convergence, error.what()};
    }
    catch (const std::exception &error)
    {
      return {Failure::Kind::other, error.what()};
    }
    return {};
  }

  void Failure::rethrow() const
  {
    switch (kind)
    {
    case Kind::none:
      return;
    case Kind::input:
      throw InputError(text);
    case Kind::machine:
      throw MachineError(text);
    case Kind::output:
      throw OutputError(text);
    case Kind::convergence:
      throw ConvergenceError(text);
    case Kind::other:
      throw std::runtime_error(text);
    }
  }
} // namespace vibrocontact

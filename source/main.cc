#include <vibrocontact/run/program.h>

int main(int argc, char **argv)
{
  return vibrocontact::run_program(vibrocontact::standard_tables(), argc, argv);
}

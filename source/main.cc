#include <vibrocontact/base/version.h>

#include <iostream>

int main()
{
  std::cout << "vibrocontact " << vibrocontact::version() << "\n";
}

#include <vibrocontact/scene/body.h>

// Phrases that several docstrings share. Literals, as only these are joined when compiled.
#pragma once

#define SALTUS_RETURNS_BUILDER \
  R"(Returns
-------
ModelBuilder
    The builder itself.
)"

/// Of an actuator.
#define SALTUS_NAME_AND_JOINT \
  R"(name : str
joint : str
    Of one coordinate.
)"

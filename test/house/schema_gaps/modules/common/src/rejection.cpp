// SPDX-License-Identifier: BSD-3-Clause
constexpr ReasonWords kReasons[] = {{Reason::kUnripe, "unripe", "{text}"}};

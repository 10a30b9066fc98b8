#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Doxygen's filter of headers: the text behind \file starts a line of its own, as Doxygen takes its
# first word for the name of a file; the name of a group stands in the line of \ingroup.
exec sed -z -E 's/\\file ([A-Z])/\\file\n * \1/g; s/\\ingroup\n *\* */\\ingroup /g' "$1"

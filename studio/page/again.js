// SPDX-License-Identifier: GPL-3.0-or-later
// A page that is loaded again has its token in this tab's storage, not in the address.
const token = sessionStorage.getItem("furrow-token");
if (token && !location.search) location.replace("/?token=" + token);

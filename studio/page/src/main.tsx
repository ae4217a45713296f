// SPDX-License-Identifier: GPL-3.0-or-later
import { render } from "preact";
import { App } from "./app";

// The token leaves the address, where it would be seen and kept by the history, for this tab's storage.
const token =
  new URLSearchParams(location.search).get("token") ?? sessionStorage.getItem("furrow-token") ?? "";
sessionStorage.setItem("furrow-token", token);
history.replaceState(null, "", location.pathname);

render(<App token={token} />, document.getElementById("app")!);

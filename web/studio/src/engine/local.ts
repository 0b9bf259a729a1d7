// SPDX-License-Identifier: Apache-2.0
// The engine of the program on this machine, behind `obvid studio`.

import type { Engine, Kind, Request } from "./engine";

export class LocalEngine implements Engine {
  readonly inPage = false;
  private readonly token: string;
  private readonly page = Math.random().toString(36).slice(2);

  constructor(address: URL) {
    this.token = address.searchParams.get("token") ?? "";
  }

  async call<T>(kind: Kind, request: Request): Promise<T> {
    return (await this.post(kind, JSON.stringify(request))) as T;
  }

  async opened(): Promise<{ name: string; text: string } | null> {
    const file = (await this.post("opened", "{}")) as { name: string; text: string };
    return file.name === "" ? null : file;
  }

  private async post(kind: string, body: string): Promise<unknown> {
    const response = await fetch(`/api/${kind}`, {
      method: "POST",
      headers: { "X-Obvid-Token": this.token, "X-Obvid-Page": this.page, "Content-Type": "application/json" },
      body,
    });
    if (!response.ok) throw new Error(`${response.status} ${await response.text()}`);
    return response.json();
  }
}
